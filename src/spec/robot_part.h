// A body of a robot, named by its place.
#pragma once

namespace clench {

/// A link by chain and number, or the base.
struct RobotPart {
  int chain = -1;  ///< -1: the base
  int link = -1;   ///< index in the chain; -1 on the base

  bool operator==(const RobotPart&) const = default;
};

}  // namespace clench
