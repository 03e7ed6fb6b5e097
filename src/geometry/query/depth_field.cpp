#include "clench/geometry/query/depth_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/triangle.h"

namespace clench {

using Eigen::Vector3d;

Sphere sphere_about(Simplex corners) {
  Sphere out{Vector3d::Zero()};
  for (const Vector3d& p : corners) out.centre += p;
  out.centre /= static_cast<double>(corners.size());
  for (const Vector3d& p : corners) out.radius = std::max(out.radius, (p - out.centre).norm());
  return out;
}

DepthField::DepthField(const Shape& solid, const Progress& progress)
    : solid_(solid),
      exposed_(exposed_surface(solid, progress)),
      surface_(exposed_.shape ? *exposed_.shape : solid) {}

Probe DepthField::probe(const Vector3d& p, int seed) const {
  const ClosestPoint near = nearest(p, seed);
  return {near.distance, near.triangle, holds(p)};
}

Slope slope_of(const Shape& shape, int triangle) {
  const Corners c = shape.mesh().corners(triangle);
  const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
  const double area = normal.norm();
  if (!(area > 0)) return {};
  const double longest =
      std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  const double extent = std::max({c[0].norm(), c[1].norm(), c[2].norm(), shape.radius()});
  return {-normal / area, 1e-9 + 1e-14 * extent * longest / area};
}

const Slope& DepthField::slope(int triangle) const {
  if (slopes_.empty()) slopes_.resize(surface_.mesh().triangles.size());
  auto& [known, slope] = slopes_[triangle];
  if (known) return slope;
  known = true;
  slope = slope_of(surface_, triangle);
  if (slope.inward.isZero(0)) return slope;
  // faces may look inward
  const Corners c = surface_.mesh().corners(triangle);
  const Vector3d middle = (c[0] + c[1] + c[2]) / 3, step = 1e-9 * solid_.radius() * slope.inward;
  const bool ahead = contains(solid_, middle + step), behind = contains(solid_, middle - step);
  if (behind) slope.inward = -slope.inward;
  if (ahead == behind) slope.inward.setZero();
  return slope;
}

GameRow DepthField::row(int triangle, Simplex corners) const {
  GameRow out{};
  const Corners c = surface_.mesh().corners(triangle);
  for (size_t j = 0; j < corners.size(); ++j) out[j] = point_triangle(corners[j], c).distance;
  return out;
}

GameRow DepthField::plane_row(int triangle, Simplex corners) const {
  const Vector3d& inward = slope(triangle).inward;
  const Vector3d p = surface_.mesh().corners(triangle)[0];
  GameRow out{};
  for (size_t j = 0; j < corners.size(); ++j) out[j] = inward.dot(corners[j] - p);
  return out;
}

GameRow DepthField::box_row(int side, Simplex corners) const {
  const Bounds& box = solid_.bounds();
  const int k = side / 2;
  GameRow out{};
  for (size_t j = 0; j < corners.size(); ++j)
    out[j] = side % 2 ? box.high[k] - corners[j][k] : corners[j][k] - box.low[k];
  return out;
}

// Least u . (p - q) over the points q of a triangle within `reach` of p, or less.
static double least_along(const Vector3d& u, const Vector3d& p, const Corners& c, double reach) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& q : c) least = std::min(least, u.dot(p - q));
  // the part of a large triangle that is within reach lies in a disk of its plane
  const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
  const double area = normal.norm();
  if (!(area > 0)) return least;
  const Vector3d n = normal / area;
  const double height = n.dot(p - c[0]), along = u.dot(n);
  const double radius = std::sqrt(std::max(0.0, reach * reach - height * height));
  const double in_plane = std::sqrt(std::max(0.0, 1 - along * along));
  return std::max(least, along * height - in_plane * radius);
}

// triangles of which is_convex judges all pairs
static constexpr int few_triangles = 20;

void DepthField::find_near(const Sphere& ball, const Probe& centre, NearTriangles& out) const {
  const double rounding = rounding_of(solid_.bounds(), ball.centre);
  out.count = 0;
  out.reach = centre.deepest(2 * ball.radius) + rounding;
  out.complete = out.reach < 0;
  // of large meshes a small part at most
  const size_t all = surface_.mesh().triangles.size();
  if (out.complete || (all > NearTriangles::most && out.reach > solid_.radius() / 4)) return;
  const Vector3d from = ball.centre - Vector3d::Map(surface_.tree().centre());
  int count = 0;
  for_near_triangles(surface_.tree(), from.data(), rounding, out.reach, false, [&](int triangle) {
    if (count < NearTriangles::most) out.triangles[count] = triangle;
    ++count;
    return false;
  });
  out.complete = count <= NearTriangles::most;
  out.count = out.complete ? count : 0;
  if (out.count > few_triangles) return;
  // exactly, for is_convex
  const auto end = out.triangles.begin() + out.count;
  out.count =
      static_cast<int>(std::remove_if(out.triangles.begin(), end,
                                      [&](int triangle) {
                                        const Corners c = surface_.mesh().corners(triangle);
                                        return point_triangle(ball.centre, c).distance > out.reach;
                                      }) -
                       out.triangles.begin());
}

// The corners of all lie in the half-spaces of all; then what is outside one of these has no
// surface in it and adjoins the outer side of a triangle.
bool DepthField::is_convex(const NearTriangles& near) const {
  if (!near.complete || near.count == 0 || near.count > few_triangles) return false;
  const double rounding = 1e-12 * solid_.radius();
  for (const int i : near.list()) {
    const Slope& s = slope(i);
    // an accurate plane
    if (s.inward.isZero(0) || s.error > 1e-8) return false;
    const Vector3d p = surface_.mesh().corners(i)[0];
    for (const int j : near.list())
      for (const Vector3d& q : surface_.mesh().corners(j))
        if (s.inward.dot(q - p) < -rounding) return false;
  }
  return true;
}

// At a point x whose nearest surface point is q, the depth increases along u where u . (x - q) > 0.
// That holds if q is far enough behind, and also if u leads inward at all triangles with the corner
// q: the surface there is a graph over the plane perpendicular to u, with the solid above it, and
// the vertical projection w of x on its tangent cone at q has (x - q) . (w - q) <= 0, since q is no
// farther from x than the points of the cone.
bool DepthField::rises(Simplex corners, const Sphere& ball, const NearTriangles& near) const {
  if (!near.complete) return false;
  const double rounding = rounding_of(solid_.bounds(), ball.centre);
  Vector3d u = Vector3d::Zero();
  std::array<Slope, NearTriangles::most> slopes;
  for (int i = 0; i < near.count; ++i) u += (slopes[i] = slope(near.triangles[i])).inward;
  constexpr int most_turns = 6;
  for (int turn = 0; turn < most_turns; ++turn) {
    if (!(u.norm() > 1e-6)) return near.count == 0;
    u.normalize();
    // no corner lies farther behind the centre
    double behind = 0;
    for (const Vector3d& p : corners) behind = std::max(behind, u.dot(ball.centre - p));
    double least = std::numeric_limits<double>::infinity();
    int worst = -1;
    for (int i = 0; i < near.count; ++i) {
      const double rise = u.dot(slopes[i].inward) - slopes[i].error;
      if (rise > 0 || rise >= least) continue;
      const Corners c = surface_.mesh().corners(near.triangles[i]);
      if (least_along(u, ball.centre, c, near.reach) <= behind + rounding) least = rise, worst = i;
    }
    if (worst < 0) return true;
    const Corners c = surface_.mesh().corners(near.triangles[worst]);
    const Vector3d away = ball.centre - point_triangle(ball.centre, c).q;
    const Vector3d& inward = slopes[worst].inward;
    u += inward.isZero(0) ? Vector3d(away.stableNormalized()) : inward;
  }
  return false;
}

}  // namespace clench
