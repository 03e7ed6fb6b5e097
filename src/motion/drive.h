// Moving until touch: a rigid body, a robot's base, the DOFs of a hand. Continuous, never tunnelling:
// every pair is advanced by no more than its distance over a bound of its speed (conservative advancement).
// source  Mirtich (1996), ch. 2; Tang, Kim & Manocha (2009), C2A
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "model/find.h"

namespace clench {

struct MoveResult {
  double fraction = 0;              ///< of the way gone, in [0, 1]
  bool touched = false;             ///< did a contact end it?
  std::vector<BodyPair> stopped_by; ///< pairs in contact that push against the motion
  int queries = 0;                  ///< distance queries it took
};

/// Moves a body along the straight line and shortest turn to X_WB, until it first touches something.
/// A body that starts in contact may leave or slide; it may not be pushed in.
/// throws Error naming the pairs when it starts in collision
MoveResult move_body(World& world, Id<Body> body, const Pose& X_WB);

/// The same for a robot that nobody carries, with everything that it carries.
MoveResult move_robot(World& world, Id<Robot> robot, const Pose& X_WB);

enum class DofStop { reached, limit, contact, still };

struct DriveOptions {
  bool stop_at_contact = false;     ///< end at the first new contact of any link
};

struct DriveResult {
  bool moved = false;               ///< did any DOF change by more than 1e-5?
  std::vector<DofStop> stops;       ///< one a DOF: why it stopped
  std::vector<BodyPair> stopped_by;
  int queries = 0;
  int events = 0;                   ///< stops of joints on the way
};

/// Drives each DOF from where it is to its target, all in proportion, until contact stops it. A contact stops
/// the joints before it that would push it in; a rigid DOF stops with any of its joints; a breakaway DOF
/// goes on with the rest. The gaps that remain are in (0, threshold].
/// targets  one a DOF, within limits [rad or m]
/// throws   Error naming the pairs when the robot starts in collision
DriveResult drive_dofs(World& world, Id<Robot> robot, const Eigen::VectorXd& targets, const DriveOptions& options = {});

/// Closes (speed > 0) or opens (speed < 0) a hand: each DOF goes towards its limit in the sense of its default
/// velocity, at a pace in proportion to it, until contact or limit.
DriveResult autograsp(World& world, Id<Robot> robot, double speed = 1, const DriveOptions& options = {});

/// Opens the hand, out of collision if need be: the overlap is resolved without regard to contacts, then
/// autograsp with speed -1.
DriveResult open_hand(World& world, Id<Robot> robot);

/// Moves a hand along its approach direction until it touches, at most `reach` [m].
MoveResult approach(World& world, Id<Robot> robot, double reach);

}  // namespace clench
