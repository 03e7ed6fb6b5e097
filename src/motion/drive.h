// Drives the DOFs of a robot until contacts stop them: rigid, breakaway and compliant couplings.
// Continuous, without tunneling.
#pragma once
#include "clench/motion/drive_result.h"

namespace clench {

/// Targets of the DOFs, and their rates relative to each other.
struct DofMotion {
  Eigen::VectorXd targets;  ///< within the limits [rad or m]
  Eigen::VectorXd rates;  ///< signed like target - q; 0: the DOF stays [rad or m per unit of path]
};

/// A contact stops the joints between it and the base that would push into it. A rigid DOF stops
/// with any of its joints; a closing breakaway DOF leaves a stopped joint behind, and picks it up
/// at the same position when it opens. The joints of a compliant DOF follow their springs, see
/// SpringBalance: the tendon pulls on, and the joints yield and slide, until contacts and friction
/// balance any further pull. A DOF whose joints are released continues. The remaining gaps are in
/// (0, threshold].
/// throws Error naming the pairs if the robot starts in collision, or if a number is invalid
DriveResult drive(World& world, Id<Robot> robot, const DofMotion& motion,
                  const DriveOptions& options = {});

/// Drives all DOFs to `targets` in proportion: without contact, along a straight line in DOF space.
DriveResult drive_to(World& world, Id<Robot> robot, const Eigen::VectorXd& targets,
                     const DriveOptions& options = {});

/// Indices of DOFs that move together.
using DofGroup = std::vector<int>;

/// Closes (speed > 0) or opens (speed < 0) a hand: each DOF moves to its limit in the direction of
/// its default velocity, at a proportional pace. Opening a closed hand also returns joints that had
/// broken away.
/// stages  run one after the other; DOFs in no stage do not move. Empty: all DOFs at once
/// throws  Error as drive() does, and for an index that no DOF has
DriveResult autograsp(World& world, Id<Robot> robot, double speed = 1,
                      const DriveOptions& options = {}, const std::vector<DofGroup>& stages = {});

/// Opens a hand as far as possible. If it starts in collision, it is first opened without regard to
/// contacts until it is free.
/// throws  Error naming the pairs if it never becomes free
DriveResult open_hand(World& world, Id<Robot> robot);

}  // namespace clench
