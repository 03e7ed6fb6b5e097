// Relaxation of the springs of compliant DOFs.
#pragma once
#include "clench/motion/drive_result.h"
#include "clench/motion/drive_state.h"

namespace clench {

enum class Springs { at_rest, moving, stopped };

struct RelaxedSprings {
  DrivePosture posture;
  Springs springs = Springs::at_rest;  ///< moving: they still creep after many changes of contact
  std::vector<BodyPair> stopped_by = {};  ///< the pair of a new contact that stopped them
  int queries = 0, events = 0;            ///< as DriveResult
};

/// Moves the joints of compliant DOFs, with the DOFs constant, until their springs are at rest
/// among the contacts, or until a new contact if options.stop_at_contact. A finger that static
/// friction does not hold slides until kinetic friction does.
/// start  posture of the robot
/// pairs  as in follow_path
RelaxedSprings relax_springs(const DrivenRobot& driven, const DrivePosture& start,
                             PairBounds& pairs, const DriveOptions& options);

}  // namespace clench
