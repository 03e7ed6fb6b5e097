// Moves rigid things until they touch: a body, or a robot by its base. Continuous, without
// tunneling.
#pragma once
#include <vector>

#include "clench/model/find.h"

namespace clench {

struct MoveResult {
  double fraction = 0;               ///< fraction of the path covered, in [0, 1]
  bool touched = false;              ///< did a contact end it?
  std::vector<BodyPair> stopped_by;  ///< moved body first
  /// true if the limit on steps ended it, while it slid for meters within micrometers
  bool iteration_limit = false;
  int queries = 0;  ///< number of distance queries
};

/// Moves an object or obstacle along the straight line and shortest turn to X_WB, until it first
/// touches something. The remaining gap is in (0, threshold]. A body that starts in contact may
/// separate or slide; it is not pushed in. A body that overlaps its support by no more than the
/// threshold is first raised against gravity, by at most 1.25 thresholds; if it overlaps a support
/// at X_WB as well, that pose is raised in the same manner.
/// throws Error naming the pairs if it starts in collision otherwise
MoveResult move_body(World& world, Id<Body> body, const Pose& X_WB);

/// Moves a robot that is not carried in the same manner, with everything that it carries.
MoveResult move_robot(World& world, Id<Robot> robot, const Pose& X_WB);

/// Moves a hand along its approach direction until it touches, by at most `reach` [m].
MoveResult approach(World& world, Id<Robot> robot, double reach);

/// throws Error  "hand:autograsp: the motion starts in collision: palm and flask" if one of the
/// bodies collides
void refuse_collision(World& world, std::span<const Id<Body>> moving, const std::string& subject);

}  // namespace clench
