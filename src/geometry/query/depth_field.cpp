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
  for (const Vector3d& p : corners) out.center += p;
  out.center /= static_cast<double>(corners.size());
  for (const Vector3d& p : corners) out.radius = std::max(out.radius, (p - out.center).norm());
  return out;
}

DepthField::DepthField(const Shape& solid, const Progress& progress)
    : solid_(solid),
      exposed_(exposed_surface(solid, progress)),
      surface_(exposed_->shape ? *exposed_->shape : solid) {}

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
  // faces may be reversed
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

GameRow DepthField::box_row(int side, Simplex corners) const {
  const Bounds& box = solid_.bounds();
  const int k = side / 2;
  GameRow out{};
  for (size_t j = 0; j < corners.size(); ++j)
    out[j] = side % 2 ? box.high[k] - corners[j][k] : corners[j][k] - box.low[k];
  return out;
}

// Lower bound of u . (p - q) over the points q of a triangle within `reach` of p.
static double min_along(const Vector3d& u, const Vector3d& p, const Corners& c, double reach) {
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

// maximum number of triangles whose pairs local_rows all examines
static constexpr int few_triangles = 24;

void DepthField::find_near(const Sphere& ball, const Probe& center, NearTriangles& out) const {
  const double rounding = rounding_of(solid_.bounds(), ball.center);
  out.count = 0;
  out.reach = center.deepest(2 * ball.radius) + rounding;
  out.complete = out.reach < 0;
  // of a large mesh, only a small part
  const size_t all = surface_.mesh().triangles.size();
  if (out.complete || (all > NearTriangles::capacity && out.reach > solid_.radius() / 4)) return;
  const Vector3d from = ball.center - Vector3d::Map(surface_.tree().center());
  int count = 0;
  for_near_triangles(surface_.tree(), from.data(), rounding, out.reach, false, [&](int triangle) {
    if (count < NearTriangles::capacity) out.triangles[count] = triangle;
    ++count;
    return false;
  });
  out.complete = count <= NearTriangles::capacity;
  out.count = out.complete ? count : 0;
  if (out.count > few_triangles) return;
  // exactly, for local_rows
  const auto end = out.triangles.begin() + out.count;
  out.count =
      static_cast<int>(std::remove_if(out.triangles.begin(), end,
                                      [&](int triangle) {
                                        const Corners c = surface_.mesh().corners(triangle);
                                        return point_triangle(ball.center, c).distance > out.reach;
                                      }) -
                       out.triangles.begin());
}

// If no near surface is in front of the plane of a triangle, the points of the ball in front of it
// are outside, and the depth is at most the distance from the plane.
// If triangles are in front of each other's planes, and any other near triangle is behind one of
// these planes, the region in front of all of them is convex and outside, and the distance from it
// is convex.
void DepthField::local_rows(Simplex corners, const Sphere& ball, const NearTriangles& near,
                            FunctionRef<void(const GameRow&, int)> take) const {
  if (!near.complete || near.count > few_triangles) return;
  const double rounding = 1e-12 * solid_.radius();
  const int count = near.count;
  // is triangle j behind the plane of i, up to rounding? Is it in front?
  std::array<std::array<bool, few_triangles>, few_triangles> behind, front;
  std::array<Vector3d, few_triangles> inward, on_plane;
  for (int i = 0; i < count; ++i) {
    const Slope& s = slope(near.triangles[i]);
    inward[i] = s.error > 1e-8 ? Vector3d(Vector3d::Zero()) : s.inward;
    on_plane[i] = surface_.mesh().corners(near.triangles[i])[0];
    for (int j = 0; j < count; ++j) {
      behind[i][j] = front[i][j] = !inward[i].isZero(0);
      for (const Vector3d& q : surface_.mesh().corners(near.triangles[j])) {
        const double height = inward[i].dot(q - on_plane[i]);
        behind[i][j] &= height >= -rounding;
        front[i][j] &= height <= rounding;
      }
    }
  }
  std::array<bool, few_triangles> done{};
  for (int i = 0; i < count; ++i) {
    if (!std::all_of(behind[i].begin(), behind[i].begin() + count, [](bool x) { return x; }))
      continue;
    done[i] = true;
    GameRow row{};
    for (size_t j = 0; j < corners.size(); ++j) row[j] = inward[i].dot(corners[j] - on_plane[i]);
    take(row, near.triangles[i]);
  }
  for (int first = 0; first < count; ++first) {
    if (done[first] || inward[first].isZero(0)) continue;
    std::array<int, few_triangles> group;
    int size = 0;
    for (int k = 0; k < count; ++k) {
      const int i = (first + k) % count;
      if (!inward[i].isZero(0) && std::all_of(group.begin(), group.begin() + size,
                                              [&](int j) { return front[i][j] && front[j][i]; }))
        group[size++] = i;
    }
    const auto end = group.begin() + size;
    for (auto i = group.begin(); i != end; ++i) done[*i] = true;
    bool valid = size > 1;
    for (int j = 0; j < count && valid; ++j)
      valid = std::any_of(group.begin(), end, [&](int i) { return i == j || behind[i][j]; });
    if (!valid) continue;
    GameRow row{};
    for (size_t j = 0; j < corners.size() && valid; ++j) {
      double nearest = std::numeric_limits<double>::infinity(), highest = -nearest;
      for (auto i = group.begin(); i != end; ++i) {
        highest = std::max(highest, inward[*i].dot(corners[j] - on_plane[*i]));
        const Closest c = point_triangle(corners[j], surface_.mesh().corners(near.triangles[*i]));
        if ((c.q - ball.center).norm() <= near.reach) nearest = std::min(nearest, c.distance);
      }
      row[j] = highest <= 0 ? 0 : nearest;
      valid = std::isfinite(row[j]);
    }
    if (valid) take(row, near.triangles[first]);
  }
}

// At a point x whose nearest surface point is q, the depth increases along u if u . (x - q) > 0.
// That holds if q is far enough behind, and also if u points inward at all triangles with the
// corner q: the surface there is a graph over the plane perpendicular to u, with the solid above
// it, and the vertical projection w of x on its tangent cone at q has (x - q) . (w - q) <= 0, since
// q is no farther from x than the points of the cone.
bool DepthField::rises(Simplex corners, const Sphere& ball, const NearTriangles& near) const {
  if (!near.complete) return false;
  const double rounding = rounding_of(solid_.bounds(), ball.center);
  Vector3d u = Vector3d::Zero();
  std::array<Slope, NearTriangles::capacity> slopes;
  for (int i = 0; i < near.count; ++i) u += (slopes[i] = slope(near.triangles[i])).inward;
  constexpr int max_turns = 6;
  for (int turn = 0; turn < max_turns; ++turn) {
    if (!(u.norm() > 1e-6)) return near.count == 0;
    u.normalize();
    // no corner lies farther behind the center
    double behind = 0;
    for (const Vector3d& p : corners) behind = std::max(behind, u.dot(ball.center - p));
    double least = std::numeric_limits<double>::infinity();
    int worst = -1;
    for (int i = 0; i < near.count; ++i) {
      const double rise = u.dot(slopes[i].inward) - slopes[i].error;
      if (rise > 0 || rise >= least) continue;
      const Corners c = surface_.mesh().corners(near.triangles[i]);
      if (min_along(u, ball.center, c, near.reach) <= behind + rounding) least = rise, worst = i;
    }
    if (worst < 0) return true;
    const Corners c = surface_.mesh().corners(near.triangles[worst]);
    const Vector3d away = ball.center - point_triangle(ball.center, c).q;
    const Vector3d& inward = slopes[worst].inward;
    u += inward.isZero(0) ? Vector3d(away.stableNormalized()) : inward;
  }
  return false;
}

}  // namespace clench
