// Driving the DOFs of a robot until contact stops them: rigid, breakaway and compliant couplings.
// Continuous, never tunneling.
#pragma once
#include "clench/motion/drive_result.h"

namespace clench {

/// Where each DOF goes and how fast, relative to the others.
struct DofMotion {
  Eigen::VectorXd targets;  ///< within the limits [rad or m]
  Eigen::VectorXd rates;  ///< signed like target - q; 0: the DOF stays [rad or m per unit of path]
};

/// A contact stops the joints between it and the base that would push it in. A rigid DOF stops with
/// any of its joints; a breakaway DOF leaves a stopped joint behind, closing, and picks it up there
/// again, opening. The joints of a compliant DOF follow their springs, see SpringBalance: it pulls
/// on, and they give way and slide, until contacts and friction take up whatever more it pulls. A
/// DOF whose joints come free goes on. The gaps that remain are in (0, threshold].
/// throws Error naming the pairs when the robot starts in collision, or when a number is out of
/// order
DriveResult drive(World& world, Id<Robot> robot, const DofMotion& motion,
                  const DriveOptions& options = {});

/// All DOFs to `targets` in proportion: without contact, on the straight line in DOF space.
DriveResult drive_to(World& world, Id<Robot> robot, const Eigen::VectorXd& targets,
                     const DriveOptions& options = {});

/// Numbers of DOFs that move together.
using DofGroup = std::vector<int>;

/// Closes (speed > 0) or opens (speed < 0) a hand: each DOF goes to its limit in the sense of its
/// default velocity, at a pace in proportion to it. Opening again what was closed brings joints
/// back that had broken away.
/// stages  one after the other; DOFs of none stay. Empty: all DOFs at once
/// throws  Error as drive() does, and for a number that no DOF has
DriveResult autograsp(World& world, Id<Robot> robot, double speed = 1,
                      const DriveOptions& options = {}, const std::vector<DofGroup>& stages = {});

/// Opens a hand as far as it goes. One that overlaps something is first opened without regard to
/// contacts, until it is free.   throws Error naming the pairs when it is never free
DriveResult open_hand(World& world, Id<Robot> robot);

}  // namespace clench
