#include <array>

#include "clench/script/bind/bind.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/spec/plausibility.h"

namespace clench {

static int get_world(lua_State* L) { return push_object(L, WorldHandle{self_body(L).world}); }

static int get_material(lua_State* L) {
  const auto body = self_body(L);
  return push(L, body.world->materials().name(body->material));
}

static int set_material(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_material(body.id, check_string(L, 2));
  return 0;
}

static int get_mass(lua_State* L) { return push(L, self_body(L)->mass); }

static void warn_of(lua_State* L, const BodyHandle& body, const void* key,
                    const std::string& doubt) {
  if (!doubt.empty()) warn_once(L, key, fmt::format("{}: {}", body->name, doubt));
}

static int set_mass(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_mass(body.id, check_number(L, 2));
  static const char told = 0;
  warn_of(L, body, &told, doubt_mass(body->mass, body->shape.get()));
  return 0;
}

static int get_com(lua_State* L) { return push(L, self_body(L)->com); }

static int set_com(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_com(body.id, check_vec3(L, 2));
  return 0;
}

static int get_inertia(lua_State* L) {
  const auto body = self_body(L);
  return push_rows(L, body->mass * body->inertia_per_mass);
}

static int set_inertia(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_inertia(body.id, read_matrix3(L, 2, {L, {}, ""}));
  return 0;
}

static int get_mesh(lua_State* L) {
  const auto body = self_body(L);
  if (body->shape) return push_object(L, body->shape);
  lua_pushnil(L);
  return 1;
}

static int get_mesh_report(lua_State* L) {
  const auto body = self_body(L);
  if (!body->mesh_report || !body->shape) {
    lua_pushnil(L);
    return 1;
  }
  const MeshReport& report = *body->mesh_report;
  push_list_of(L, describe(report, *body->shape), [&](const std::string& line) { push(L, line); });
  set_field(L, "format", report.format);
  set_field(L, "unit", report.unit);
  set_field(L, "unit_source", source_name(report.unit_source));
  set_field(L, "up", std::string(1, report.up));
  set_field(L, "triangles_read", report.triangles_read);
  set_field(L, "vertices_read", report.vertices_read);
  set_field(L, "welded_vertices", report.welded_vertices);
  set_field(L, "unused_vertices", report.unused_vertices);
  set_field(L, "dropped_triangles", report.dropped_triangles);
  set_field(L, "flipped", report.flipped);
  return 1;
}

static int get_restitution(lua_State* L) { return push(L, self_body(L)->restitution); }

static int set_restitution(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_restitution(body.id, check_number(L, 2));
  return 0;
}

static int get_elastic_modulus(lua_State* L) {
  const auto body = self_body(L);
  if (body->elastic_modulus) return push(L, *body->elastic_modulus);
  lua_pushnil(L);
  return 1;
}

static int set_elastic_modulus(lua_State* L) {
  const auto body = self_body(L);
  std::optional<double> modulus;
  if (given(L, 2)) modulus = check_number(L, 2);
  body.world->set_elastic_modulus(body.id, modulus);
  static const char told = 0;
  if (const std::string doubt = modulus ? doubt_modulus(*modulus) : ""; !doubt.empty())
    warn_of(L, body, &told, "elastic_modulus " + doubt);
  return 0;
}

static int get_soft_layer(lua_State* L) { return push(L, self_body(L)->soft_layer); }

static int set_soft_layer(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_soft_layer(body.id, check_number(L, 2));
  return 0;
}

static int get_poisson_ratio(lua_State* L) { return push(L, self_body(L)->poisson_ratio); }

static int set_poisson_ratio(lua_State* L) {
  const auto body = self_body(L);
  body.world->set_poisson_ratio(body.id, check_number(L, 2));
  return 0;
}

static int get_entity_contacts(lua_State* L) {
  const auto body = self_body(L);
  const std::array on{body.id};
  return push_contacts(L, body.world, contacts(*body.world, body.world->bodies(), on));
}

static int get_color(lua_State* L) {
  const Eigen::Vector3d color = self_body(L)->appearance.color.cast<double>();
  return push_vector(L, color);
}

static int set_color(lua_State* L) {
  const auto body = self_body(L);
  Appearance appearance = body->appearance;
  appearance.color = check_vec3(L, 2).cast<float>();
  appearance.triangle_colors.clear();
  appearance.given = true;
  body.world->set_appearance(body.id, appearance);
  return 0;
}

static int get_transparency(lua_State* L) {
  return push(L, static_cast<double>(self_body(L)->appearance.transparency));
}

static int set_transparency(lua_State* L) {
  const auto body = self_body(L);
  Appearance appearance = body->appearance;
  appearance.transparency = static_cast<float>(check_number(L, 2));
  body.world->set_appearance(body.id, appearance);
  return 0;
}

static const Entry entity_fields[] = {
    {"world", guarded<get_world>, R"(
The world that it is in.
@type world
> flask.world == world, hand.world == world  --> true, true)"},
    {"material", guarded<get_material>, R"(
Name of its material, which decides its friction.
@type string
> flask.material = "rubber"
> flask.material  --> rubber
> flask.material = "ruber"  --> error: rubber)",
     guarded<set_material>},
    {"mass", guarded<get_mass>, R"(
Its mass.
@type number  [kg]
> flask.mass = 0.5
> flask.mass  --> 0.5)",
     guarded<set_mass>},
    {"com", guarded<get_com>, R"(
Centre of mass in the body frame. Setting it takes an inertia that comes from its shape to the new centre; one that was
given stays.
@type vec3  [m]
> flask.com = {0, 0, 0.01}
> flask.com  --> (0, 0, 0.01))",
     guarded<set_com>},
    {"inertia", guarded<get_inertia>, R"(
Inertia about the centre of mass, in the body's axes, as rows. It scales with the mass. No principal moment may exceed the
sum of the others: no body has such an inertia.
@type number[][]  [kg m^2]
> flask.mass = 1
> flask.inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}
> flask.inertia[1]  --> {1.0, 0.0, 0.0}
> flask.inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}  --> error: one of 1.5 times that sum)",
     guarded<set_inertia>},
    {"mesh", guarded<get_mesh>, R"(
Its surface; nil when it has none.
@type mesh?
> flask.mesh:is_watertight()  --> true)"},
    {"mesh_report", guarded<get_mesh_report>, R"(
How the triangles of its file were read and repaired: lines of text, and the same as fields `format`, `unit` [m],
`unit_source` ("format", "file", "option" or "guess"), `up` (the axis of the file that became z), `triangles_read`,
`vertices_read`, `welded_vertices`, `unused_vertices`, `dropped_triangles` (without area, or lying on others), `flipped`
(was it inside out?). Nil when it has no mesh, or none from a file.
@type table?
> flask.mesh_report.unit  --> 0.001
> flask.mesh_report.unit_source  --> format
> flask.mesh_report.flipped  --> false)"},
    {"restitution", guarded<get_restitution>, R"(
How it bounces: speed after a blow by that before, from 0 to 1. Of two bodies the larger counts, unless set_friction says
what holds for their materials.
@type number
> flask.restitution  --> 0.0
> flask.restitution = 2  --> error: restitution)",
     guarded<set_restitution>},
    {"elastic_modulus", guarded<get_elastic_modulus>, R"(
Young's modulus; nil when it is rigid.
@type number?  [Pa]
> flask.elastic_modulus = 1.5e6
> flask.elastic_modulus  --> 1500000.0)",
     guarded<set_elastic_modulus>},
    {"soft_layer", guarded<get_soft_layer>, R"(
Height of the soft layer of an elastic body.
@type number  [m]
> flask.soft_layer  --> 0.003
> flask.soft_layer = 0.005
> flask.soft_layer = 0  --> error: expected a number from 1e-09 to 1e+09 [m], got 0)",
     guarded<set_soft_layer>},
    {"poisson_ratio", guarded<get_poisson_ratio>, R"(
Poisson's ratio of an elastic body, below 0.5: its layer gives way by modulus / (1 - ratio^2).
@type number
> flask.poisson_ratio  --> 0.0
> flask.poisson_ratio = 0.5  --> error: expected a number from 0 to 0.499999, got 0.5)",
     guarded<set_poisson_ratio>},
    {"contacts", guarded<get_entity_contacts>, R"(
Contacts of other bodies with it now.
@type contact[]
> #flask.contacts == #world:contacts(hand, flask)  --> true)"},
    {"color", guarded<get_color>, R"(
Colour in pictures: red, green and blue in 0..1.
@type number[]
> flask.color = {1, 0.5, 0}
> flask.color  --> {1.0, 0.5, 0.0})",
     guarded<set_color>},
    {"transparency", guarded<get_transparency>, R"(
From 0, opaque, to 1, invisible.
@type number
> flask.transparency = 0.5
> flask.transparency  --> 0.5)",
     guarded<set_transparency>},
};

const Class entity_class{.name = "entity",
                         .variable = "entity",
                         .doc =
                             "What bodies and robots have in common; a robot "
                             "has what its base has.",
                         .fields = entity_fields,
                         .methods = {}};

}  // namespace clench
