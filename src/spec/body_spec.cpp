#include "spec/body_spec.h"

#include <algorithm>

#include "base/error.h"

namespace clench {

// radius of gyration of things without extent, squared: a millimetre
static constexpr double point_inertia = 1e-6;

void check_mass(double mass, const std::string& subject) {
  if (!(mass > 0) || mass > largest_number)
    fail("{}: its mass must be > 0 and at most {} [kg], got {}", subject, largest_number, mass);
}

Eigen::Vector3d com_of(const BodySpec& spec) {
  if (spec.com) return *spec.com;
  if (!spec.shape) return Eigen::Vector3d::Zero();
  return spec.shape->has_volume() ? spec.shape->solid().centroid
                                  : surface_centroid(spec.shape->mesh());
}

Eigen::Matrix3d inertia_of(const BodySpec& spec) {
  if (spec.inertia_per_mass) return *spec.inertia_per_mass;
  if (!spec.shape) return point_inertia * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d com = com_of(spec);
  if (!spec.shape->has_volume()) {
    const double r = largest_radius(spec.shape->mesh(), com);
    return std::max(0.4 * r * r, point_inertia) * Eigen::Matrix3d::Identity();
  }
  // parallel axes from the centroid to a centre that the file may have put elsewhere
  const MassProperties& solid = spec.shape->solid();
  const Eigen::Vector3d off = com - solid.centroid;
  return solid.inertia + off.squaredNorm() * Eigen::Matrix3d::Identity() - off * off.transpose();
}

}  // namespace clench
