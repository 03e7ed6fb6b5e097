#include "clench/model/fingerprint.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/world/meshes.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"

#include <fmt/format.h>

#include <algorithm>

#include "clench/base/watched.h"
#include "clench/geometry/query/bounding_boxes.h"
#include "clench/io/mesh/write_mesh.h"
#include "clench/script/bind/output.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

static const Shape& shape_of(lua_State* L) { return *self<ShapePtr>(L); }

static const std::vector<Eigen::Vector3d>& vertices_of(const ShapePtr& shape) {
  return shape->mesh().vertices;
}

static int get_triangles(lua_State* L) {
  return push_list_of(L, shape_of(L).mesh().triangles, [&](const Triangle& t) {
    push_list_of(L, t, [&](int index) { push(L, index + 1); });
  });
}

static int push_surface_point(lua_State* L, const Shape& shape, const Eigen::Vector3d& point,
                              int triangle) {
  const auto [a, b, c] = shape.mesh().corners(triangle);
  return push_record(L, {{"point", point},
                         {"normal", (b - a).cross(c - a).stableNormalized()},
                         {"triangle", triangle + 1}});
}

static int closest(lua_State* L) {
  const Shape& shape = shape_of(L);
  const ClosestPoint near = closest_point(shape, check_vec3(L, 2, "point"));
  push_surface_point(L, shape, near.point, near.triangle);
  set_field(L, "distance", near.distance);
  return 1;
}

static int holds(lua_State* L) { return push(L, contains(shape_of(L), check_vec3(L, 2, "point"))); }

static int sample(lua_State* L) {
  const Shape& shape = shape_of(L);
  Random& random = check_object<Random>(L, 2, "random");
  const int count = check_int(L, 3, "count");
  constexpr int most = 1'000'000;
  if (count < 0 || count > most)
    fail("{}: count: expected 0 to {}, got {}", subject(L), most, count);
  // cumulative area of the triangles, including each
  std::vector<double> areas;
  double sum = 0;
  for (int t = 0; t < std::ssize(shape.mesh().triangles); ++t) {
    const auto [a, b, c] = shape.mesh().corners(t);
    areas.push_back(sum += 0.5 * (b - a).cross(c - a).norm());
  }
  if (!(sum > 0)) fail("{}: the mesh has no area", subject(L));
  push_list(L, count);
  StopCheck check(1 << 12);
  for (int i = 1; i <= count; ++i) {
    check();
    const double at = random.uniform(0, sum);
    const auto t = std::min<std::ptrdiff_t>(std::ranges::upper_bound(areas, at) - areas.begin(),
                                            std::ssize(areas) - 1);
    const auto [a, b, c] = shape.mesh().corners(static_cast<int>(t));
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    push_surface_point(L, shape, a + u * (b - a) + v * (c - a), static_cast<int>(t));
    lua_rawseti(L, -2, i);
  }
  return 1;
}

static int boxes_of(lua_State* L) {
  const Watching watching(L);
  const auto boxes = bounding_boxes(shape_of(L), check_int(L, 2, "depth"), watching.progress());
  return push_list_of(L, boxes, [&](const OrientedBox& box) {
    push_record(L, {{"pose", box.X_MB}, {"size", Eigen::Vector3d(2 * box.half)}});
  });
}

static int mesh_save(lua_State* L) {
  write_mesh(shape_of(L).mesh(), check_output(L, 2));
  return 0;
}

static std::string mesh_text(const ShapePtr& shape) {
  const Eigen::Vector3d size = shape->bounds().size();
  return fmt::format("mesh of {} triangles, {:.4g} x {:.4g} x {:.4g} m, {}",
                     shape->mesh().triangles.size(), size.x(), size.y(), size.z(),
                     shape->faults().describe());
}

static const Entry mesh_fields[] = {
    {"triangle_count",
     getter<[](const ShapePtr& x) { return static_cast<int>(x->mesh().triangles.size()); }>,
     R"(
Number of triangles.
@type integer
> world:add_object(clench.shapes.box {1, 1, 1}).mesh.triangle_count  --> 12)"},
    {"vertex_count",
     getter<[](const ShapePtr& x) { return static_cast<int>(x->mesh().vertices.size()); }>, R"(
Number of vertices.
@type integer
> world:add_object(clench.shapes.box {1, 1, 1}).mesh.vertex_count  --> 8)"},
    {"bounds", getter<[](const ShapePtr& x) { return x->bounds(); }>, R"(
Axis-aligned bounds in the body frame.
@type {low: vec3, high: vec3}  [m]
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.bounds.high  --> (0.5, 1, 2))"},
    {"volume", getter<[](const ShapePtr& x) { return x->solid().volume; }>, R"(
Volume inside the surface; parts that overlap count twice. Meaningful if it is watertight.
@type number  [m^3]
> math.abs(world:add_object(clench.shapes.box {1, 2, 4}).mesh.volume - 8) < 1e-12  --> true)"},
    {"centroid", getter<[](const ShapePtr& x) { return x->solid().centroid; }>, R"(
Center of that volume: the center of mass of a uniform solid. Meaningful if it is watertight.
@type vec3  [m]
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.centroid:norm() < 1e-12  --> true)"},
    {"area", getter<[](const ShapePtr& x) { return x->mesh().area(); }>, R"(
Area of all its triangles.
@type number  [m^2]
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.area  --> 28.0)"},
    {"faults", getter<[](const ShapePtr& x) { return x->faults().describe(); }>, R"(
Number of its faults of each kind.
@type string
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.faults  --> no faults)"},
    {"fingerprint", getter<[](const ShapePtr& x) { return fingerprint_text(fingerprint(*x)); }>, R"(
Equal for surfaces of the same triangles, in any order and with any numbering of vertices.
@type string  16 hexadecimal digits
> world:add_object(clench.shapes.box {1, 2, 4}).mesh.fingerprint == world:add_object(clench.shapes.box {1, 2, 4}).mesh.fingerprint  --> true)"},
    {"vertices", getter<vertices_of>, R"(
A list of all vertices in the body frame.
@type vec3[]  [m]
> #world:add_object(clench.shapes.box {1, 1, 1}).mesh.vertices  --> 8)"},
    {"triangles", guarded<get_triangles>, R"(
A list of all triangles: vertex numbers from 1, counter-clockwise from outside.
@type index[][]
> #world:add_object(clench.shapes.box {1, 1, 1}).mesh.triangles  --> 12)"},
};

static const Entry mesh_methods[] = {
    {"is_watertight", method<[](const ShapePtr& x) { return x->closed(); }>, R"(
Does the surface bound a solid: does every edge join two triangles of consistent orientation?
@return boolean
@effect reads
> world:add_object(clench.shapes.box {1, 1, 1}).mesh:is_watertight()  --> true)"},
    {"closest_point", guarded<closest>, R"(
The surface point nearest to a point of the body frame, with the outward normal of its triangle there.
@param point vec3  [m]
@return {point: vec3, normal: vec3, triangle: index, distance: number}  [m]
@effect reads
> near = world:add_object(clench.shapes.box {1, 1, 1}).mesh:closest_point {0.1, 0, 2}
> near.point, near.normal, near.distance  --> (0.1, 0, 0.5), (0, 0, 1), 1.5)"},
    {"contains", guarded<holds>, R"(
Is a point of the body frame inside the solid? No point is inside an open mesh.
@param point vec3  [m]
@return boolean
@effect reads
> world:add_object(clench.shapes.box {1, 1, 1}).mesh:contains {0.1, 0, 0.4}  --> true)"},
    {"bounding_boxes", guarded<boxes_of>, R"(
The boxes of the tree that collision queries descend, in the body frame: one at depth 0, up to eight times as many at each further depth.
Branches that end earlier are represented by their last boxes.
@param depth integer [0 to 6]  levels below the box of the complete mesh
@return {pose: pose, size: vec3}[]  pose: of the center; size: along the axes of the pose [m]
@effect reads
> boxes = world:add_object(clench.shapes.box {1, 2, 4}).mesh:bounding_boxes(0)
> #boxes, math.abs(boxes[1].size.x * boxes[1].size.y * boxes[1].size.z - 8) < 1e-3  --> 1, true
> flask.mesh:bounding_boxes(7)  --> error: depth: expected 0 to 6, got 7)"},
    {"sample", guarded<sample>, R"(
Random points on the surface, uniformly distributed by area, with the outward normals of their triangles.
@param random random  source of the random numbers
@param count integer [0 to 1000000]  number of points
@return {point: vec3, normal: vec3, triangle: index}[]  [m]
@effect reads
> points = flask.mesh:sample(clench.random(1), 3)
> #points, flask.mesh:closest_point(points[1].point).distance < 1e-9  --> 3, true)"},
    {"save", guarded<mesh_save>, R"(
Writes the triangles, in meters. Numbers are written with all digits, in .stl with seven.
@param path string  .obj .off .ply .stl
@effect files
> path = os.tmpname() .. ".obj"
> flask.mesh:save(path)
> world:add_object(path).mesh.volume == flask.mesh.volume  --> true
> os.remove(path)
> flask.mesh:save "flask.glb"  --> error: flask.glb: expected a mesh to .obj, .off, .ply or .stl, got '.glb')"},
};

static const Entry mesh_operators[] = {
    {"__tostring", method<mesh_text>, ""},
    {"__eq", equality<ShapePtr>, ""},
};

const Class mesh_class{
    .name = "mesh",
    .variable = "mesh",
    .doc =
        "The triangles of a body's surface. Meshes never change, and clones of a world share them.",
    .fields = mesh_fields,
    .methods = mesh_methods,
    .operators = mesh_operators};

}  // namespace clench
