// Penalty energies of constraints on a hand: 0 if a constraint is satisfied, increasing with its
// violation.
#pragma once
#include "clench/planning/energy/energy.h"

namespace clench {

/// Angle between the approach direction and an axis in excess of a limit [rad].
/// axis  in world axes, of any length but 0;  max_angle  in [0, pi] [rad]
EnergyPtr approach_cone_energy(Id<Robot> hand, const Eigen::Vector3d& axis, double max_angle);

/// Penetration of the hand's bodies into a box of space, by their bounding boxes [mm].
/// low, high  corners, along the axes of X_WK
EnergyPtr keep_out_energy(Id<Robot> hand, const Pose& X_WK, const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high);

/// Violation of a minimum distance between the hand and bodies that are neither its own nor the
/// grasped object [mm].
EnergyPtr clearance_energy(const HandAndObject& who, double min_distance);

/// Excess over a radius of the distance between the approach frame's origin and a point: the reach
/// of an arm [mm].
EnergyPtr reach_energy(Id<Robot> hand, const Eigen::Vector3d& p_W, double radius);

/// Penetration of the hand in what it collides with: the sum over the colliding pairs of bodies of
/// the depth of the deepest of some points on either surface, plus a thousandth per pair, so that
/// it is 0 only if nothing collides [mm]. If no point lies inside, the penetration depth is used,
/// to 0.1 mm + 10 %.
/// points  on each body of the hand, >= 1
EnergyPtr penetration_energy(const World& world, Id<Robot> hand, int points = 64);

}  // namespace clench
