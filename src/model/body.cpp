#include "model/body.h"

namespace clench {

double Body::max_radius() const { return shape ? largest_radius(shape->mesh(), com) : 0; }

// radius of gyration of things without extent, squared: a millimetre
static constexpr double point_inertia = 1e-6;

static Eigen::Vector3d default_com(const BodySpec& spec) {
  if (!spec.shape) return Eigen::Vector3d::Zero();
  return spec.shape->has_volume() ? spec.shape->solid().centroid
                               : surface_centroid(spec.shape->mesh());
}

static Eigen::Matrix3d default_inertia(const BodySpec& spec, const Eigen::Vector3d& com) {
  if (!spec.shape) return point_inertia * Eigen::Matrix3d::Identity();
  if (!spec.shape->has_volume()) {
    const double r = largest_radius(spec.shape->mesh(), com);
    return std::max(0.4 * r * r, point_inertia) * Eigen::Matrix3d::Identity();
  }
  // parallel axes from the centroid to a centre that the file may have put elsewhere
  const MassProperties& solid = spec.shape->solid();
  const Eigen::Vector3d off = com - solid.centroid;
  return solid.inertia + off.squaredNorm() * Eigen::Matrix3d::Identity() - off * off.transpose();
}

Body make_body(const BodySpec& spec, BodyKind kind, const Pose& X_WB) {
  Body body;
  body.name = spec.name;
  body.source = spec.source;
  body.file = spec.file;
  body.kind = kind;
  body.shape = spec.shape;
  body.mesh_report = spec.mesh_report;
  body.appearance = spec.appearance;
  body.X_WB = X_WB;
  body.mass = spec.mass;
  body.com = spec.com ? *spec.com : default_com(spec);
  body.inertia_per_mass =
      spec.inertia_per_mass ? *spec.inertia_per_mass : default_inertia(spec, body.com);
  body.elastic_modulus = spec.elastic_modulus;
  body.tracker = spec.tracker;
  return body;
}

}  // namespace clench
