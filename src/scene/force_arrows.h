// Forces in pictures.
#pragma once
#include <span>

#include "clench/model/find.h"
#include "clench/scene/scene.h"

namespace clench {

/// A force on the body at the point; world frame.
struct PlacedForce {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d f_W = Eigen::Vector3d::Zero();  ///< [N]
};

/// The resultant of the forces on each patch of contacts, at its center of pressure: the mean of
/// the contact points, weighted by normal forces. Without normal forces, at the center of the
/// patch.
/// forces  one per contact, at its point
std::vector<PlacedForce> patch_forces(std::span<const Contact> contacts,
                                      std::span<const PlacedForce> forces);

/// One arrow per force, which ends at its point: its length is the force times meters_per_newton, >
/// 0. Forces below a thousandth of the largest are left out.
std::vector<DrawArrow> force_arrows(std::span<const PlacedForce> forces, double meters_per_newton);

/// Labels of the eight longest such arrows with their forces in newtons, beyond their tails; the
/// largest first.
std::vector<DrawLabel> force_labels(std::span<const PlacedForce> forces, double meters_per_newton);

/// The scale at which the arrow of the largest force has this length [m]; 1 without forces.
double force_scale(std::span<const PlacedForce> forces, double longest);

}  // namespace clench
