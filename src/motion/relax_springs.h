// The springs of compliant DOFs come to rest.
#pragma once
#include "clench/motion/drive_result.h"
#include "clench/motion/drive_state.h"

namespace clench {

enum class Springs { at_rest, moving, stopped };

struct RelaxedSprings {
  DrivePosture posture;
  Springs springs = Springs::at_rest;     ///< moving: they creep on after many changes of contact
  std::vector<BodyPair> stopped_by = {};  ///< the pair of a new touch that stopped them
  int queries = 0, events = 0;            ///< as DriveResult
};

/// Lets springs come to rest among the contacts, the DOFs where they are, or a new touch stop them
/// where one is to. A finger that static friction does not hold slides until kinetic friction does.
/// start  how the robot stands
/// pairs  as of follow_path
RelaxedSprings relax_springs(const DrivenRobot& driven, const DrivePosture& start,
                             PairBounds& pairs, const DriveOptions& options);

}  // namespace clench
