#include "clench/model/body.h"

namespace clench {

double Body::max_radius() const { return shape ? largest_radius(shape->mesh(), com) : 0; }

Body make_body(const BodySpec& spec, BodyKind kind) {
  Body body;
  body.name = spec.name;
  body.source = spec.source;
  body.file = spec.file;
  body.kind = kind;
  body.shape = spec.shape;
  body.mesh_report = spec.mesh_report;
  body.appearance = spec.appearance;
  body.mass = spec.mass;
  body.material_from = spec.material_from;
  body.mass_from = spec.mass_from;
  body.com = com_of(spec);
  body.inertia_per_mass = inertia_of(spec);
  body.elastic_modulus = spec.elastic_modulus;
  body.soft_layer = spec.soft_layer;
  body.poisson_ratio = spec.poisson_ratio;
  body.restitution = spec.restitution;
  body.free_damping = spec.free_damping;
  body.free_friction = spec.free_friction;
  body.free_armature = spec.free_armature;
  body.gravity_compensation = spec.gravity_compensation;
  body.tracker = spec.tracker;
  return body;
}

}  // namespace clench
