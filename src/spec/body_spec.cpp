#include "clench/spec/body_spec.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/spec/inertia.h"

namespace clench {

// squared radius of gyration of things without extent: a millimeter
static constexpr double point_inertia = 1e-6;

void check_body(const BodySpec& spec, std::string_view what) {
  check_name(spec.name, what);
  const std::string subject = fmt::format("{} '{}'", what, excerpt(spec.name));
  check(mass_rule, spec.mass, subject);
  if (spec.com) check(coordinate_rule.called("com"), *spec.com, subject);
  if (spec.inertia_per_mass) check_inertia(*spec.inertia_per_mass, subject);
  if (spec.elastic_modulus) check(elastic_modulus_rule, *spec.elastic_modulus, subject);
  check(soft_layer_rule, spec.soft_layer, subject);
  check(poisson_ratio_rule, spec.poisson_ratio, subject);
  check(restitution_rule, spec.restitution, subject);
  check_each(not_negative_rule,
             {{"free damping", spec.free_damping},
              {"free friction", spec.free_friction},
              {"free armature", spec.free_armature}},
             subject);
  check(number_rule.called("gravity compensation"), spec.gravity_compensation, subject);
}

void check_appearance(const Appearance& appearance, std::string_view subject) {
  check(share_rule.called("color"), appearance.color.cast<double>(), subject);
  check(share_rule.called("transparency"), appearance.transparency, subject);
}

Eigen::Vector3d com_of(const BodySpec& spec) {
  if (spec.com) return *spec.com;
  if (!spec.shape) return Eigen::Vector3d::Zero();
  return spec.shape->has_volume() ? spec.shape->solid().centroid
                                  : surface_centroid(spec.shape->mesh());
}

// of the solid bounded by the surface; empty if there is none
static std::optional<Eigen::Matrix3d> solid_inertia(const BodySpec& spec) {
  if (!spec.shape->has_volume()) return {};
  // parallel axis theorem, from the centroid to a center of mass that the file may have set
  const MassProperties& solid = spec.shape->solid();
  const Eigen::Vector3d off = com_of(spec) - solid.centroid;
  const Eigen::Matrix3d inertia =
      solid.inertia + off.squaredNorm() * Eigen::Matrix3d::Identity() - off * off.transpose();
  if (inertia_fault(inertia) != InertiaFault::none) return {};
  return inertia;
}

Eigen::Matrix3d inertia_of(const BodySpec& spec) {
  if (spec.inertia_per_mass) return *spec.inertia_per_mass;
  if (!spec.shape) return point_inertia * Eigen::Matrix3d::Identity();
  if (const auto inertia = solid_inertia(spec)) return *inertia;
  const double r = largest_radius(spec.shape->mesh(), com_of(spec));
  return std::max(0.4 * r * r, point_inertia) * Eigen::Matrix3d::Identity();
}

bool inertia_is_of_ball(const BodySpec& spec) {
  return !spec.inertia_per_mass && spec.shape && !solid_inertia(spec);
}

}  // namespace clench
