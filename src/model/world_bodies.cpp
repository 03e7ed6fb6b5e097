// Properties of the bodies of a world.
#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/world.h"
#include "clench/spec/inertia.h"

namespace clench {

void World::set_material(Id<Body> id, std::string_view material) {
  edit(id).material = settings_->materials.index(material);
  edit(id).material_from = Origin::script;
}

void World::set_mass(Id<Body> id, double mass) {
  check(mass_rule, mass, the_body(body(id).name));
  edit(id).mass = mass;
  edit(id).mass_from = Origin::script;
}

void World::set_com(Id<Body> id, const Eigen::Vector3d& com) {
  check(coordinate_rule.called("com"), com, the_body(body(id).name));
  Body& b = edit(id);
  BodySpec spec;
  spec.shape = b.shape;
  spec.com = b.com;
  // an inertia that was computed from the shape is computed again about the new center
  const bool from_shape = b.inertia_per_mass == inertia_of(spec);
  b.com = spec.com.emplace(com);
  if (from_shape) b.inertia_per_mass = inertia_of(spec);
}

void World::set_inertia(Id<Body> id, const Eigen::Matrix3d& inertia) {
  const Body& b = body(id);
  const Eigen::Matrix3d per_mass = inertia / b.mass;
  check_inertia(per_mass, the_body(b.name));
  edit(id).inertia_per_mass = per_mass;
}

void World::set_elastic_modulus(Id<Body> id, std::optional<double> modulus) {
  if (modulus) check(elastic_modulus_rule, *modulus, the_body(body(id).name));
  edit(id).elastic_modulus = modulus;
}

void World::set_soft_layer(Id<Body> id, double height) {
  check(soft_layer_rule, height, the_body(body(id).name));
  edit(id).soft_layer = height;
}

void World::set_poisson_ratio(Id<Body> id, double ratio) {
  check(poisson_ratio_rule, ratio, the_body(body(id).name));
  edit(id).poisson_ratio = ratio;
}

void World::set_restitution(Id<Body> id, double ratio) {
  check(restitution_rule, ratio, the_body(body(id).name));
  edit(id).restitution = ratio;
}

static void check_resistance(double value, const char* name, const std::string& subject) {
  check(not_negative_rule.called(name), value, subject);
}

void World::set_free_damping(Id<Body> id, double damping) {
  check_resistance(damping, "free damping", the_body(body(id).name));
  edit(id).free_damping = damping;
}

void World::set_free_friction(Id<Body> id, double friction) {
  check_resistance(friction, "free friction", the_body(body(id).name));
  edit(id).free_friction = friction;
}

void World::set_free_armature(Id<Body> id, double armature) {
  check_resistance(armature, "free armature", the_body(body(id).name));
  edit(id).free_armature = armature;
}

void World::set_gravity_compensation(Id<Body> id, double part) {
  check(number_rule.called("gravity compensation"), part, the_body(body(id).name));
  edit(id).gravity_compensation = part;
}

void World::set_appearance(Id<Body> id, const Appearance& appearance) {
  check_appearance(appearance, the_body(body(id).name));
  edit(id).appearance = appearance;
}

void World::set_kind(Id<Body> id, BodyKind kind) {
  const Body& b = body(id);
  const std::string name = excerpt(b.name);
  if (b.robot)
    fail("body '{}' is a part of robot '{}': its kind cannot change", name,
         excerpt(robot(b.robot).name));
  if (kind != BodyKind::object && kind != BodyKind::obstacle)
    fail("body '{}': kind: expected object or obstacle", name);
  if (b.kind == kind) return;
  if (const auto weld = dynamic_settings().welds.find(id); weld != dynamic_settings().welds.end())
    fail("body '{}' is welded to '{}': it cannot become an obstacle", name,
         excerpt(body(weld->second).name));
  edit(id).kind = kind;
  come_to_rest(id);
}

}  // namespace clench
