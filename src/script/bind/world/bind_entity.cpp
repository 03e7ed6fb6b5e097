#include <array>

#include "clench/io/mesh/image_file.h"
#include "clench/model/fingerprint.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/bind/world/meshes.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/spec/plausibility.h"

namespace clench {

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

static int get_mesh_report(lua_State* L) {
  const auto body = self_body(L);
  if (!body->mesh_report || !body->shape) return push_nil(L);
  const MeshReport& report = *body->mesh_report;
  push(L, describe(report, *body->shape));
  set_fields(L, {{"format", report.format},
                 {"unit", report.unit},
                 {"unit_source", source_name(report.unit_source)},
                 {"up", std::string(1, report.up)},
                 {"triangles_read", report.triangles_read},
                 {"vertices_read", report.vertices_read},
                 {"welded_vertices", report.welded_vertices},
                 {"unused_vertices", report.unused_vertices},
                 {"dropped_triangles", report.dropped_triangles},
                 {"flipped", report.flipped}});
  return 1;
}

static int set_elastic_modulus(lua_State* L) {
  const auto body = self_body(L);
  const auto modulus = read_as<std::optional<double>>(L, 2, {L, {}, ""});
  body.world->set_elastic_modulus(body.id, modulus);
  static const char told = 0;
  if (const std::string doubt = modulus ? doubt_modulus(*modulus) : ""; !doubt.empty())
    warn_of(L, body, &told, "elastic_modulus " + doubt);
  return 0;
}

static int get_entity_contacts(lua_State* L) {
  const auto body = self_body(L);
  const std::array on{body.id};
  return push_contacts(L, body.world, contacts(*body.world, body.world->bodies(), on));
}

static std::array<double, 3> color_of(const Entity& body) {
  const Eigen::Vector3f& color = body->appearance.color;
  return {color.x(), color.y(), color.z()};
}

// one {red, green, blue} per triangle; nil if the body has a single color
static int get_triangle_colors(lua_State* L) {
  const auto body = self_body(L);
  const auto& colors = body->appearance.triangle_colors;
  if (colors.empty()) return push_nil(L);
  lua_createtable(L, static_cast<int>(colors.size()), 0);
  for (size_t i = 0; i < colors.size(); ++i) {
    lua_createtable(L, 3, 0);
    for (int k = 0; k < 3; ++k) {
      lua_pushnumber(L, static_cast<double>(colors[i][k]));
      lua_rawseti(L, -2, k + 1);
    }
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

static const char* word_of_wrap(Wrap wrap) {
  return wrap == Wrap::repeat ? "repeat" : wrap == Wrap::mirror ? "mirror" : "clamp";
}

static void push_texture(lua_State* L, const Texture& texture) {
  constexpr int largest_side = 1024, quality = 90;
  lua_newtable(L);
  const auto image = image_within(texture.image, largest_side);
  set_fields(L, {{"jpeg", encode_as_jpeg(*image, quality)},
                 {"width", image->width},
                 {"height", image->height},
                 {"wrap_u", word_of_wrap(texture.wrap_u)},
                 {"wrap_v", word_of_wrap(texture.wrap_v)}});
  lua_createtable(L, 3, 0);
  for (int k = 0; k < 3; ++k) {
    lua_pushnumber(L, static_cast<double>(texture.tint[k]));
    lua_rawseti(L, -2, k + 1);
  }
  lua_setfield(L, -2, "tint");
}

// images as bytes of files, numbers and image coordinates of triangles packed
static int get_textures(lua_State* L) {
  const auto body = self_body(L);
  const SkinPtr& skin = body->appearance.skin;
  if (!skin) return push_nil(L);
  std::string numbers, places;
  for (const TexturedTriangle& triangle : skin->triangles) {
    const auto number = static_cast<uint16_t>(triangle.texture + 1);
    numbers.push_back(static_cast<char>(number & 255));
    numbers.push_back(static_cast<char>(number >> 8));
    places.append(reinterpret_cast<const char*>(triangle.uv.data()), 6 * sizeof(float));
  }
  lua_newtable(L);
  set_fields(L, {{"numbers", numbers}, {"places", places}});
  lua_createtable(L, static_cast<int>(skin->textures.size()), 0);
  for (size_t i = 0; i < skin->textures.size(); ++i) {
    push_texture(L, skin->textures[i]);
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setfield(L, -2, "images");
  return 1;
}

static void set_color(const Entity& body, const Eigen::Vector3d& color) {
  Appearance appearance = body->appearance;
  appearance.color = color.cast<float>();
  appearance.triangle_colors.clear();
  appearance.skin.reset();
  appearance.given = true;
  body.world->set_appearance(body.id, appearance);
}

static void set_transparency(const Entity& body, double transparency) {
  Appearance appearance = body->appearance;
  appearance.transparency = static_cast<float>(transparency);
  body.world->set_appearance(body.id, appearance);
}

static const char* word_of_origin(Origin origin) {
  return origin == Origin::assumed ? "assumed" : origin == Origin::file ? "file" : "script";
}

static const Entry entity_fields[] = {
    {"world", getter<[](const Entity& x) { return WorldHandle{x.world}; }>, R"(
The world that contains it.
@type world
> flask.world == world, hand.world == world  --> true, true)"},
    {"material", getter<[](const Entity& x) { return x.world->materials().name(x->material); }>, R"(
Name of its material, which decides its friction.
@type string
> flask.material = "rubber"
> flask.material  --> rubber
> flask.material = "ruber"  --> error: rubber)",
     setter<[](const Entity& x, const std::string& name) { x.world->set_material(x.id, name); }>},
    {"material_from", getter<[](const Entity& x) { return word_of_origin(x->material_from); }>,
     R"(
Origin of the material: its file, a script or an option; without any of them it is assumed.
@type "assumed"|"file"|"script"
> world:add_object("models/objects/flask.iv", {name = "other", material = "glass"}).material_from  --> script)"},
    {"mass_from", getter<[](const Entity& x) { return word_of_origin(x->mass_from); }>, R"(
Origin of the mass, in the same terms.
@type "assumed"|"file"|"script"
> world:add_object(clench.shapes.box {0.01, 0.01, 0.01}, {name = "cube"}).mass_from  --> assumed)"},
    {"mass", getter<[](const Entity& x) { return x->mass; }>, R"(
Its mass.
@type number  [kg]
> flask.mass = 0.5
> flask.mass  --> 0.5)",
     guarded<set_mass>},
    {"com", getter<[](const Entity& x) { return x->com; }>, R"(
Center of mass in the body frame. Setting it moves an inertia that was derived from the shape to the new center; an inertia that was
given is unchanged.
@type vec3  [m]
> flask.com = {0, 0, 0.01}
> flask.com  --> (0, 0, 0.01))",
     setter<[](const Entity& x, const Eigen::Vector3d& com) { x.world->set_com(x.id, com); }>},
    {"inertia",
     getter<[](const Entity& x) { return Eigen::Matrix3d(x->mass * x->inertia_per_mass); }>, R"(
Inertia about the center of mass, in the body's axes, as rows. It scales with the mass. No principal moment may exceed the
sum of the others, as for every real body.
@type number[][]  [kg m^2]
> flask.mass = 1
> flask.inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}
> flask.inertia[1]  --> {1.0, 0.0, 0.0}
> flask.inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}  --> error: one of 1.5 times that sum)",
     setter<[](const Entity& x, const Eigen::Matrix3d& inertia) {
       x.world->set_inertia(x.id, inertia);
     }>},
    {"fingerprint",
     getter<[](const Entity& x) { return fingerprint_text(fingerprint(*x.world, x.id)); }>,
     R"(
Identity by content: equal for bodies of the same surface, mass, inertia and material, whatever their files, names and poses.
@type string  16 hexadecimal digits
> same = clench.world():add_object(flask.source)
> same.fingerprint == flask.fingerprint  --> true
> same.mass = 2 * same.mass
> same.fingerprint == flask.fingerprint  --> false)"},
    {"mesh", getter<[](const Entity& x) { return x->shape; }>, R"(
Its surface; nil when it has none.
@type mesh?
> flask.mesh:is_watertight()  --> true)"},
    {"visual_mesh",
     getter<[](const Entity& x) { return x->appearance.visual ? x->appearance.visual : x->shape; }>,
     R"(
The mesh that pictures and pages draw: that for display if the file has one, otherwise its surface; nil if it has none.
@type mesh?
> flask.visual_mesh == flask.mesh  --> true)"},
    {"triangle_colors", guarded<get_triangle_colors>, R"(
Colors of the triangles of `visual_mesh`, red, green and blue from 0 to 1, if the file has several, by materials or textures; nil
if the body has one color.
@type number[][]?
> flask.triangle_colors  --> nil)"},
    {"textures", guarded<get_textures>, R"(
Images on the triangles of `visual_mesh`, as its file maps them; nil if it has none. `images` is a list of `{jpeg =, width =, height =,
wrap_u =, wrap_v =, tint =}`: the bytes of a JPEG file of at most 1024 pixels per side, how the image continues beyond its edges ("repeat", "mirror" or
"clamp"), and the factor of its colors. `numbers` and `places` are bytes for `string.unpack`: for each triangle the number of its image,
`"<I2"`, 0 for none, and u and v of its three corners, `"<ffffff"`, v down from the top. Setting `color` removes the textures.
@type table?
> flask.textures  --> nil)"},
    {"mesh_report", guarded<get_mesh_report>, R"(
How the triangles of its file were read and repaired: lines of text, and the same data as fields `format`, `unit` [m],
`unit_source` ("format", "file", "option" or "guess"), `up` (the axis of the file that became z), `triangles_read`,
`vertices_read`, `welded_vertices`, `unused_vertices`, `dropped_triangles` (without area, or lying on others), `flipped`
(was it inside out?). nil if it has no mesh, or none from a file.
@type table?
> flask.mesh_report.unit  --> 0.001
> flask.mesh_report.unit_source  --> format
> flask.mesh_report.flipped  --> false)"},
    {"restitution", getter<[](const Entity& x) { return x->restitution; }>, R"(
Restitution: ratio of the speeds after and before an impact, from 0 to 1. The larger value of two bodies is used, unless set_friction has
a value for their materials.
@type number
> flask.restitution  --> 0.0
> flask.restitution = 2  --> error: restitution)",
     setter<[](const Entity& x, double value) { x.world->set_restitution(x.id, value); }>},
    {"free_damping", getter<[](const Entity& x) { return x->free_damping; }>, R"(
Viscous resistance of an object that moves freely, or of the base of a robot that floats: a force on the origin of its frame
against that point's velocity, and a torque against its turning.
@type number  [N s/m and N m s/rad]
> flask.free_damping = 2
> flask.free_damping  --> 2.0
> flask.free_damping = -1  --> error: free damping)",
     setter<[](const Entity& x, double value) { x.world->set_free_damping(x.id, value); }>},
    {"free_friction", getter<[](const Entity& x) { return x->free_friction; }>, R"(
Dry resistance of a free object, or of a floating robot base: at most this force on the origin of
its frame along each axis of the world, and at most this torque about each axis of the body.
@type number  [N and N m]
> flask.free_friction  --> 0.0)",
     setter<[](const Entity& x, double value) { x.world->set_free_friction(x.id, value); }>},
    {"free_armature", getter<[](const Entity& x) { return x->free_armature; }>, R"(
Inertia without weight of an object that moves freely, or of the base of a robot that floats: a mass at the origin of its
frame, and a moment about every axis.
@type number  [kg and kg m^2]
> flask.free_armature  --> 0.0)",
     setter<[](const Entity& x, double value) { x.world->set_free_armature(x.id, value); }>},
    {"gravity_compensation", getter<[](const Entity& x) { return x->gravity_compensation; }>, R"(
Fraction of its weight that is left out of simulations: 1 for a body that floats. MuJoCo calls it `gravcomp`.
@type number
> flask.gravity_compensation  --> 0.0)",
     setter<[](const Entity& x, double value) { x.world->set_gravity_compensation(x.id, value); }>},
    {"elastic_modulus", getter<[](const Entity& x) { return x->elastic_modulus; }>, R"(
Young's modulus; nil if it is rigid.
@type number?  [Pa]
> flask.elastic_modulus = 1.5e6
> flask.elastic_modulus  --> 1500000.0)",
     guarded<set_elastic_modulus>},
    {"soft_layer", getter<[](const Entity& x) { return x->soft_layer; }>, R"(
Height of the soft layer of an elastic body.
@type number  [m]
> flask.soft_layer  --> 0.003
> flask.soft_layer = 0.005
> flask.soft_layer = 0  --> error: expected a number from 1e-09 to 1e+09 [m], got 0)",
     setter<[](const Entity& x, double value) { x.world->set_soft_layer(x.id, value); }>},
    {"poisson_ratio", getter<[](const Entity& x) { return x->poisson_ratio; }>, R"(
Poisson's ratio of an elastic body, below 0.5: its layer deforms by modulus / (1 - ratio^2).
@type number
> flask.poisson_ratio  --> 0.0
> flask.poisson_ratio = 0.5  --> error: expected a number from 0 to 0.499999, got 0.5)",
     setter<[](const Entity& x, double value) { x.world->set_poisson_ratio(x.id, value); }>},
    {"contacts", guarded<get_entity_contacts>, R"(
Present contacts of other bodies with it.
@type contact[]
> #flask.contacts == #world:contacts(hand, flask)  --> true)"},
    {"color", getter<color_of>, R"(
Color in pictures: red, green and blue in 0..1.
@type number[]
> flask.color = {1, 0.5, 0}
> flask.color  --> {1.0, 0.5, 0.0})",
     setter<set_color>},
    {"transparency", getter<[](const Entity& x) { return double{x->appearance.transparency}; }>, R"(
From 0, opaque, to 1, invisible.
@type number
> flask.transparency = 0.5
> flask.transparency  --> 0.5)",
     setter<set_transparency>},
};

const Class entity_class{
    .name = "entity",
    .variable = "entity",
    .doc = "Properties common to bodies and robots; a robot has those of its base.",
    .fields = entity_fields};

}  // namespace clench
