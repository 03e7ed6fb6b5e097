#include "clench/script/bind/bind.h"

#include <fmt/format.h>

#include "clench/io/mesh/write_mesh.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static const Shape& shape_of(lua_State* L) { return *self<ShapePtr>(L); }

static int get_triangle_count(lua_State* L) {
  return push(L, static_cast<int>(shape_of(L).mesh().triangles.size()));
}
static int get_vertex_count(lua_State* L) {
  return push(L, static_cast<int>(shape_of(L).mesh().vertices.size()));
}
static int get_volume(lua_State* L) { return push(L, shape_of(L).solid().volume); }
static int get_area(lua_State* L) { return push(L, shape_of(L).mesh().area()); }
static int get_faults(lua_State* L) { return push(L, shape_of(L).faults().describe()); }
static int is_watertight(lua_State* L) { return push(L, shape_of(L).closed()); }

static int get_centroid(lua_State* L) { return push(L, shape_of(L).solid().centroid); }

static int get_bounds(lua_State* L) {
  push_list(L, 0, 2);
  set_field(L, "low", shape_of(L).bounds().low);
  set_field(L, "high", shape_of(L).bounds().high);
  return 1;
}

static int get_vertices(lua_State* L) {
  return push_list_of(L, shape_of(L).mesh().vertices,
                      [&](const Eigen::Vector3d& v) { push(L, v); });
}

static int get_triangles(lua_State* L) {
  return push_list_of(L, shape_of(L).mesh().triangles, [&](const Triangle& t) {
    push_list_of(L, t, [&](int index) { push(L, index + 1); });
  });
}

static int save(lua_State* L) {
  write_mesh(shape_of(L).mesh(), check_string(L, 2, "path"));
  return 0;
}

static int text(lua_State* L) {
  const Shape& shape = shape_of(L);
  const Eigen::Vector3d size = shape.bounds().size();
  return push(L, fmt::format("mesh of {} triangles, {:.4g} x {:.4g} x {:.4g} m, {}",
                             shape.mesh().triangles.size(), size.x(), size.y(), size.z(),
                             shape.faults().describe()));
}

static int equal(lua_State* L) {
  const auto *a = to<ShapePtr>(L, 1), *b = to<ShapePtr>(L, 2);
  return push(L, a && b && *a == *b);
}

static const Entry fields[] = {
    {"triangle_count", guarded<get_triangle_count>, R"(
How many triangles it has.
@type integer
> world:add_object(clench.shapes.box {1, 1, 1}).mesh.triangle_count  --> 12)"},
    {"vertex_count", guarded<get_vertex_count>, R"(
How many vertices it has.
@type integer
> world:add_object(clench.shapes.box {1, 1, 1}).mesh.vertex_count  --> 8)"},
    {"bounds", guarded<get_bounds>, R"(
Axis-aligned bounds in the body frame.
@type {low: vec3, high: vec3}  [m]
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.bounds.high  --> (0.5, 1, 2))"},
    {"volume", guarded<get_volume>, R"(
Volume that the surface bounds; parts that overlap count twice. Meaningful when it is watertight.
@type number  [m^3]
> math.abs(world:add_object(clench.shapes.box {1, 2, 4}).mesh.volume - 8) < 1e-12  --> true)"},
    {"centroid", guarded<get_centroid>, R"(
Centre of that volume: the centre of mass of a uniform solid. Meaningful when it is watertight.
@type vec3  [m]
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.centroid:norm() < 1e-12  --> true)"},
    {"area", guarded<get_area>, R"(
Area of all its triangles.
@type number  [m^2]
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.area  --> 28.0)"},
    {"faults", guarded<get_faults>, R"(
Counts of its faults.
@type string
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.faults  --> no faults)"},
    {"vertices", guarded<get_vertices>, R"(
A list of all vertices in the body frame.
@type vec3[]  [m]
> #world:add_object(clench.shapes.box {1, 1, 1}).mesh.vertices  --> 8)"},
    {"triangles", guarded<get_triangles>, R"(
A list of all triangles: vertex numbers from 1, counter-clockwise from outside.
@type integer[][]
> #world:add_object(clench.shapes.box {1, 1, 1}).mesh.triangles  --> 12)"},
};

static const Entry methods[] = {
    {"is_watertight", guarded<is_watertight>, R"(
Does the surface bound a solid: every edge between two triangles that agree?
@return boolean
> world:add_object(clench.shapes.box {1, 1, 1}).mesh:is_watertight()  --> true)"},
    {"save", guarded<save>, R"(
Writes the triangles, in metres. Numbers keep every digit, in .stl seven.
@param path string  .obj .off .ply .stl
> path = os.tmpname() .. ".obj"
> flask.mesh:save(path)
> world:add_object(path).mesh.volume == flask.mesh.volume  --> true
> os.remove(path)
> flask.mesh:save "flask.glb"  --> error: flask.glb: expected a mesh to .obj, .off, .ply or .stl, got '.glb')"},
};

static const Entry operators[] = {
    {"__tostring", guarded<text>, ""},
    {"__eq", guarded<equal>, ""},
};

const Class mesh_class{.name = "mesh",
                       .variable = "mesh",
                       .doc =
                           "The triangles of a body's surface. Meshes never "
                           "change, and clones of a world share them.",
                       .fields = fields,
                       .methods = methods,
                       .operators = operators};

}  // namespace clench
