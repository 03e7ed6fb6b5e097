#include "clench/grasp/wrench/projection.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "clench/base/error.h"
#include "clench/grasp/wrench/expanding_polytope.h"
#include "clench/grasp/wrench/slice.h"

namespace clench {

namespace {

// Corners of slices result from linear programs, accurate to about 1e-11.
constexpr double slice_tolerance = 1e-10;
constexpr int max_faces = 500'000;

// the coordinates that the options leave free
std::array<int, 3> free_coordinates(const WrenchSpace& space, const ProjectionOptions& options) {
  std::vector<int> left = space.options().coordinates;
  const auto take = [&](int coordinate) {
    if (coordinate < 0 || coordinate > 5)
      fail("wrench space: project: coordinates must be 0 to 5, got {}", coordinate);
    const auto place = std::find(left.begin(), left.end(), coordinate);
    if (place == left.end())
      fail("wrench space: project: {} is named twice, or is no coordinate of this space",
           coordinate_names[coordinate]);
    left.erase(place);
  };
  for (const auto& [coordinate, value] : options.fixed) {
    take(coordinate);
    if (!std::isfinite(value))
      fail("wrench space: project: {} must be finite, got {}", coordinate_names[coordinate], value);
  }
  for (const int coordinate : options.projected) take(coordinate);
  if (left.size() != 3) {
    std::string names;
    for (const int coordinate : left)
      names += (names.empty() ? ": " : ", ") + std::string(coordinate_names[coordinate]);
    fail("wrench space: project: expected three free coordinates, got {}{}", left.size(), names);
  }
  return {left[0], left[1], left[2]};
}

Mesh mesh_of(const Facets& facets, int exponent) {
  Mesh mesh;
  for (size_t i = 0; i + 2 < facets.points.size(); i += 3)
    mesh.vertices.emplace_back(std::ldexp(facets.points[i], exponent),
                               std::ldexp(facets.points[i + 1], exponent),
                               std::ldexp(facets.points[i + 2], exponent));
  double signed_volume = 0;
  const Eigen::Vector3d inner = mesh.vertices[facets.corners[0]];
  for (size_t i = 0; i + 2 < facets.corners.size(); i += 3) {
    const Triangle t = {facets.corners[i], facets.corners[i + 1], facets.corners[i + 2]};
    const Eigen::Vector3d a = mesh.vertices[t[0]] - inner, b = mesh.vertices[t[1]] - inner,
                          c = mesh.vertices[t[2]] - inner;
    signed_volume += a.dot(b.cross(c));
    mesh.triangles.push_back(t);
  }
  if (signed_volume < 0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);

  // points inside the last surface are not corners
  std::vector<int> place(mesh.vertices.size(), -1);
  std::vector<Eigen::Vector3d> kept;
  for (Triangle& t : mesh.triangles)
    for (int& corner : t) {
      if (place[corner] < 0) {
        place[corner] = static_cast<int>(kept.size());
        kept.push_back(mesh.vertices[corner]);
      }
      corner = place[corner];
    }
  mesh.vertices = std::move(kept);
  return mesh;
}

}  // namespace

Projection project(const WrenchSpace& space, const ProjectionOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    fail("wrench space: project: tolerance must be > 0, got {}", options.tolerance);
  Projection out{.free = free_coordinates(space, options),
                 .fixed = options.fixed,
                 .projected = options.projected,
                 .volume = 0,
                 .mesh = {}};
  WrenchSpaceOptions turned = space.options();
  turned.coordinates.assign(out.free.begin(), out.free.end());
  Eigen::VectorXd values(static_cast<int>(options.fixed.size()));
  for (size_t i = 0; i < options.fixed.size(); ++i) {
    turned.coordinates.push_back(options.fixed[i].first);
    values[static_cast<int>(i)] = options.fixed[i].second;
  }
  const WrenchSpace turned_space(space.contacts(), turned);
  const int exponent = turned_space.scale_exponent();
  for (double& value : values) value = std::ldexp(value, -exponent);

  const auto nothing = [&] {
    std::string all;
    for (const auto& [coordinate, value] : options.fixed)
      all += fmt::format("{}{} = {}", all.empty() ? "" : ", ", coordinate_names[coordinate], value);
    fail("wrench space: project: no wrench of it has {}", all);
  };
  const FacetsOptions facets_options{
      .tolerance = space.is_round() ? options.tolerance : slice_tolerance,
      .max_facets = max_faces,
      .progress = options.progress};
  Facets facets;
  if (turned_space.scaled_reach().empty()) {
    if (!values.isZero(0)) nothing();
    return out;
  }
  if (values.size() == 0) {
    facets = all_facets(turned_space.scaled_reach(), facets_options);
  } else {
    const Slice slice(turned_space.scaled_reach(), values);
    if (slice.empty()) nothing();
    facets = all_facets(slice, facets_options);
  }
  if (facets.end == FacetsEnd::too_many)
    fail(ErrorKind::limit, "wrench space: project: it has more than {} faces", max_faces);
  if (facets.end == FacetsEnd::failed)
    fail(ErrorKind::internal, "wrench space: project: rounding broke its surface");
  if (facets.end == FacetsEnd::flat) return out;
  out.volume = std::ldexp(facets.volume, 3 * exponent);
  out.mesh = mesh_of(facets, exponent);
  return out;
}

}  // namespace clench
