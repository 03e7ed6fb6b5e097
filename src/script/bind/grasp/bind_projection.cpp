#include <algorithm>
#include <cmath>

#include "clench/scene/wrench_scene.h"
#include "clench/script/bind/grasp/wrench_spaces.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/world/meshes.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

int project_space(lua_State* L) {
  const WrenchSpace& s = *self<WrenchSpacePtr>(L);
  Table table(L, 2);
  ProjectionOptions options;
  options.tolerance = table.number("tolerance", options.tolerance);
  if (const int type = table.push("fixed"); type == LUA_TTABLE) {
    // in the order of coordinates, independent of that of the table
    Table fixed(L, lua_gettop(L), table.what("fixed").text());
    for (int c = 0; c < 6; ++c)
      if (fixed.has(coordinate_names[c]))
        options.fixed.emplace_back(c, fixed.number(coordinate_names[c]));
    fixed.done();
  } else if (type != LUA_TNIL) {
    fail_expected(table.what("fixed"), "a table of coordinates and values", -1);
  }
  lua_pop(L, 1);
  if (auto projected = read_coordinates(table, "projected"))
    options.projected = std::move(*projected);
  table.done();
  const Watching watching(L);
  options.progress = watching.progress();
  ProjectionHandle handle{std::make_shared<Projection>(project(s, options)), nullptr,
                          self<WrenchSpacePtr>(L)};
  if (!handle.projection->mesh.triangles.empty())
    handle.shape = Shape::make(handle.projection->mesh, "projection");
  return push(L, handle);
}

static std::map<std::string, double> fixed_of(const ProjectionHandle& x) {
  std::map<std::string, double> fixed;
  for (const auto& [coordinate, value] : x.projection->fixed)
    fixed[coordinate_names[coordinate]] = value;
  return fixed;
}

// "L1 wrench space: fx fy fz at tx = 0, any ty tz"
static std::string title_of(const ProjectionHandle& handle) {
  const Projection& p = *handle.projection;
  std::string title = fmt::format("{} wrench space: {} {} {}", norm_name(*handle.space),
                                  coordinate_names[p.free[0]], coordinate_names[p.free[1]],
                                  coordinate_names[p.free[2]]);
  const char* between = " at ";
  for (const auto& [coordinate, value] : p.fixed) {
    title += fmt::format("{}{} = {:.4g}", between, coordinate_names[coordinate], value);
    between = ", ";
  }
  if (!p.projected.empty()) title += p.fixed.empty() ? " any" : ", any";
  for (const int coordinate : p.projected)
    title += fmt::format(" {}", coordinate_names[coordinate]);
  return title;
}

// radius of the section of the ball of epsilon
static double ball_of(const ProjectionHandle& handle) {
  double square = handle.space->epsilon() * handle.space->epsilon();
  for (const auto& [coordinate, value] : handle.projection->fixed) square -= value * value;
  return std::sqrt(std::max(0.0, square));
}

static int draw_projection(lua_State* L) {
  const auto& handle = self<ProjectionHandle>(L);
  if (!handle.shape) fail("{}: it is flat, with volume 0: there is nothing to draw", subject(L));
  const Projection& p = *handle.projection;
  Table options(L, 2);
  WrenchPicture showing{.solid = handle.shape};
  // contacts resist the weakest wrench by its opposite, the direction of the smallest reach
  Eigen::Vector3d least;
  for (int k = 0; k < 3; ++k) {
    showing.axes[k] = coordinate_names[p.free[k]];
    least[k] = -handle.space->weakest().direction[p.free[k]];
  }
  if (options.boolean("ball", true)) showing.ball = ball_of(handle);
  if (options.boolean("weakest", true)) showing.weakest = least;
  showing.title = title_of(handle);
  showing.epsilon = handle.space->epsilon();
  return push_object(L, draw_scene(L, options, make_wrench_scene(showing)));
}

static std::string projection_text(const ProjectionHandle& x) {
  const Projection& p = *x.projection;
  return fmt::format("projection to {} {} {}, volume {:.6g}", coordinate_names[p.free[0]],
                     coordinate_names[p.free[1]], coordinate_names[p.free[2]], p.volume);
}

static const Entry projection_fields[] = {
    {"volume", getter<[](const ProjectionHandle& x) { return x.projection->volume; }>, R"(
Volume in the three coordinates; 0 if it is flat.
@type number
> grasp:wrench_space():project{projected = {"tx", "ty", "tz"}}.volume > 0  --> true)"},
    {"mesh", getter<[](const ProjectionHandle& x) { return x.shape; }>, R"(
Its surface, with the free coordinates as x, y and z; nil if it is flat.
@type mesh
> grasp:wrench_space():project{fixed = {tx = 0, ty = 0, tz = 0}}.mesh:is_watertight()  --> true)"},
    {"free", getter<[](const ProjectionHandle& x) { return names_of(x.projection->free); }>, R"(
The free coordinates, which are x, y and z of the mesh.
@type string[]
> grasp:wrench_space():project{projected = {"tx", "ty", "tz"}}.free[1]  --> fx)"},
    {"fixed", getter<fixed_of>, R"(
The values of the coordinates that were fixed.
@type table<string, number>
> grasp:wrench_space():project{fixed = {tx = 0, ty = 0, tz = 0.01}}.fixed.tz  --> 0.01)"},
    {"projected",
     getter<[](const ProjectionHandle& x) { return names_of(x.projection->projected); }>, R"(
The coordinates that may have any value.
@type string[]
> #grasp:wrench_space():project{projected = {"tx", "ty", "tz"}}.projected  --> 3)"},
};

static const Entry projection_methods[] = {
    {"render", guarded<draw_projection>, R"(
Draws it transparently, with its axes and their numbers [N], the part of the ball of epsilon that lies in it, and the
weakest direction; size, samples and camera as in clench.render.
@param options? table  what is shown, and the picture
@option ball? boolean = true  true: the largest ball in the space
@option weakest? boolean = true  true: the weakest wrench
@like clench.render  size, quality, background, outline, letters, samples, style, eye, target, up, field_of_view, orthographic, camera
@return picture
@effect long
> forces = grasp:wrench_space():project{fixed = {tx = 0, ty = 0, tz = 0}}
> forces:render{size = {64, 48}}  --> picture of 64 x 48 pixels)"},
};

static const Entry projection_operators[] = {
    {"__tostring", method<projection_text>, ""},
};

const Class projection_class{.name = "projection",
                             .variable = "projection",
                             .doc = "A wrench space in three coordinates.",
                             .fields = projection_fields,
                             .methods = projection_methods,
                             .operators = projection_operators};

}  // namespace clench
