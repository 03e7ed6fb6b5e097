#include "clench/script/bind/read_spec.h"

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/read_mesh_table.h"
#include "clench/script/bind/world/meshes.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/home.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

// a unit by its name, or by its length in meters
static std::optional<double> read_unit(Table& options) {
  const bool named = options.has("unit"), scaled = options.has("mesh_scale");
  if (named && scaled) fail("{}: expected unit or mesh_scale, got both", options.subject());
  if (scaled) return options.number("mesh_scale");
  if (!named) return {};
  return options.choice(
      "unit", {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"inch", 0.0254}, {"foot", 0.3048}}, 1.0);
}

std::filesystem::path check_folder(const std::string& name, const std::string& subject) {
  std::error_code code;
  if (!std::filesystem::is_directory(name, code))
    fail("{}: expected a folder, got '{}'", subject, name);
  return name;
}

std::filesystem::path read_confine(lua_State* L, Table& options) {
  const std::string chosen = get_setting(L, Setting::confine);
  const std::string folder = options.string("confine", chosen);
  return options.has("confine") ? check_folder(folder, options.subject() + ": confine")
                                : std::filesystem::path(folder);
}

ReadOptions read_places(lua_State* L, int i) {
  Table options(L, i);
  ReadOptions reading;
  reading.confine = read_confine(L, options);
  reading.home = home_folder();
  options.done();
  return reading;
}

ReadOptions read_options(lua_State* L, Table& options) {
  ReadOptions out;
  const std::string root = options.string("root", "");
  if (!root.empty()) out.root = check_folder(root, options.subject() + ": root");
  out.confine = read_confine(L, options);
  out.home = home_folder();
  out.mesh_scale = read_unit(options);
  out.progress = Progress(bar_of(L));
  out.diagnostics = Diagnostics([L](const Diagnostic& diagnostic) { log(L, diagnostic); });
  return options.boolean("strict", false) ? strict(std::move(out)) : out;
}

// of a solid of that density [kg/m^3]
static double mass_of(lua_State* L, const BodySpec& spec, double density) {
  if (!spec.shape) fail("{}: density: expected a body with a mesh, got a frame", subject(L));
  if (!spec.shape->has_volume())
    fail("{}: density: expected a watertight mesh, got one with {}; give its mass", subject(L),
         spec.shape->closed() ? "no volume" : spec.shape->faults().describe());
  return density * std::abs(spec.shape->solid().volume);
}

static void override_spec(lua_State* L, BodySpec& spec, Table& options) {
  spec.name = options.string("name", spec.name);
  if (options.has("material")) spec.material_from = Origin::script;
  if (options.has("mass") || options.has("density")) spec.mass_from = Origin::script;
  spec.material = options.string("material", spec.material);
  if (options.has("density")) {
    if (options.has("mass")) fail("{}: expected mass or density, got both", subject(L));
    spec.mass = mass_of(L, spec, options.number("density"));
    spec.inertia_told = true;  // by the density
  }
  spec.mass = options.number("mass", spec.mass);
  if (options.has("com")) spec.com = options.vec3("com");
  if (options.has("elastic_modulus")) spec.elastic_modulus = options.number("elastic_modulus");
  spec.soft_layer = options.number("soft_layer", spec.soft_layer);
  spec.poisson_ratio = options.number("poisson_ratio", spec.poisson_ratio);
  spec.restitution = options.number("restitution", spec.restitution);
  spec.free_damping = options.number("free_damping", spec.free_damping);
  spec.free_friction = options.number("free_friction", spec.free_friction);
  spec.free_armature = options.number("free_armature", spec.free_armature);
  spec.gravity_compensation = options.number("gravity_compensation", spec.gravity_compensation);
  if (options.has("color")) {
    spec.appearance.color = options.vec3("color").cast<float>();
    spec.appearance.triangle_colors.clear();
    spec.appearance.skin.reset();
    spec.appearance.given = true;
  }
  spec.appearance.transparency =
      static_cast<float>(options.number("transparency", spec.appearance.transparency));
  if (options.push("inertia") != LUA_TNIL)
    spec.inertia_per_mass = read_matrix3(L, -1, options.what("inertia")) / spec.mass;
  lua_pop(L, 1);
  check_body(spec, options.subject() + ": body");
  check_appearance(spec.appearance, options.subject());
}

BodySpec check_body_spec(lua_State* L, int i, Table& options, const ReadOptions& reading) {
  BodySpec spec;
  if (lua_type(L, i) == LUA_TSTRING) {
    spec = read_body(find_file(check_string(L, i, "path"), {}, reading), reading);
  } else if (const ShapePtr* given = to<ShapePtr>(L, i); given || lua_istable(L, i)) {
    const std::string name = options.string("name", "body");
    spec.name = name;
    MeshTable mesh;
    if (given)
      mesh = {(*given)->mesh(), (*given)->rounds()};
    else
      mesh = read_mesh_table(L, i, reading);
    if (reading.mesh_scale) mesh.scale(*reading.mesh_scale);
    spec.shape = Shape::make(std::move(mesh.mesh), name, {}, std::move(mesh.rounds));
  } else {
    fail_expected({L, {}, "body"},
                  "a file name, a mesh of a body, or one {vertices = ..., triangles = ...}", i);
  }
  override_spec(L, spec, options);
  return spec;
}

}  // namespace clench
