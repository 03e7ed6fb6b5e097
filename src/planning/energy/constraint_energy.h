// Energies that keep a hand where it may be: 0 where it is, growing with how far it is not.
#pragma once
#include "clench/planning/energy/energy.h"

namespace clench {

/// How much the approach direction leans from an axis beyond an angle [rad].
/// axis  in world axes, of any length but 0;  max_angle  in [0, pi] [rad]
EnergyPtr approach_cone_energy(Id<Robot> hand, const Eigen::Vector3d& axis, double max_angle);

/// How deep the hand's bodies reach into a box of space, by the boxes around them [mm].
/// low, high  corners, along the axes of X_WK
EnergyPtr keep_out_energy(Id<Robot> hand, const Pose& X_WK, const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high);

/// How much nearer than a distance the hand is to bodies that are not its own and not what it
/// grasps [mm].
EnergyPtr clearance_energy(const HandAndObject& who, double min_distance);

/// How much farther than a radius the approach frame's origin is from a point: what an arm reaches
/// [mm].
EnergyPtr reach_energy(Id<Robot> hand, const Eigen::Vector3d& p_W, double radius);

/// Depth of the hand in what it collides with: the sum over the pairs of bodies that collide of the
/// depth of the deepest of some points on either surface, plus a thousandth per pair, so that it is
/// 0 only where nothing collides [mm]. Where no point lies inside, the depth of the overlap counts,
/// up to 0.1 mm + 10 %.
/// points  on each body of the hand, >= 1
EnergyPtr penetration_energy(const World& world, Id<Robot> hand, int points = 64);

}  // namespace clench
