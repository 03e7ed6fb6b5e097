// The distance of points inside a solid from its surface, with bounds over simplices. For the
// queries of this module only.
#pragma once
#include <array>
#include <span>

#include "clench/base/function_ref.h"
#include "clench/geometry/query/exposed.h"
#include "clench/geometry/query/queries.h"
#include "clench/math/matrix_game.h"

namespace clench {

/// Corners of a triangle (3) or a tetrahedron (4).
using Simplex = std::span<const Eigen::Vector3d>;

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]
};

/// A sphere that contains the corners.
Sphere sphere_about(Simplex corners);

/// A point relative to a solid.
struct Probe {
  double distance = 0;  ///< to the surface [m]
  int triangle = -1;    ///< the nearest triangle
  bool inside = false;
  /// upper bound of the depth in the ball about the point
  double deepest(double radius) const { return (inside ? distance : -distance) + radius; }
};

/// Unit inward normal of a triangle whose corners run counter-clockwise from outside, and the error
/// bound of its components; zero for a triangle without area.
struct Slope {
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();
  double error = 0;
};

Slope slope_of(const Shape& shape, int triangle);

/// Triangles of a surface that contain the nearest points of all points inside the solid in a ball.
struct NearTriangles {
  static constexpr int capacity = 256;
  std::array<int, capacity> triangles;
  int count = 0;
  bool complete = false;  ///< false: not searched, or too many
  double reach = 0;       ///< of the center, about which the points lie [m]

  std::span<const int> list() const { return {triangles.data(), static_cast<size_t>(count)}; }
};

/// Triangles are those of the surface.
class DepthField {
 public:
  /// solid  closed
  DepthField(const Shape& solid, const Progress& progress);

  const Shape& solid() const { return solid_; }
  /// the triangle of the solid that contains one of the surface
  int triangle_of_solid(int triangle) const {
    return exposed_->shape ? exposed_->triangles[triangle] : triangle;
  }
  /// Surface point nearest to p.
  /// seed  a triangle likely to be near, -1 for none
  ClosestPoint nearest(const Eigen::Vector3d& p, int seed = -1) const {
    return closest_point(surface_, p, seed);
  }
  bool holds(const Eigen::Vector3d& p) const { return contains(solid_, p); }
  Probe probe(const Eigen::Vector3d& p, int seed = -1) const;
  /// center  the probe of the ball's center
  void find_near(const Sphere& ball, const Probe& center, NearTriangles& out) const;
  /// Does the depth certainly have no local maximum in the simplex? True if it increases along one
  /// direction in the complete part of the simplex inside the solid.
  bool rises(Simplex corners, const Sphere& ball, const NearTriangles& near) const;

  /// Values at the corners whose linear interpolation is an upper bound of the depth everywhere in
  /// the simplex.
  GameRow row(int triangle, Simplex corners) const;
  /// The same for the few triangles near the simplex, passed to take(row, triangle): the signed
  /// distance from the plane of a triangle if nothing near is in front of it, and the distance from
  /// several triangles if these bound a convex part of the outside.
  void local_rows(Simplex corners, const Sphere& ball, const NearTriangles& near,
                  FunctionRef<void(const GameRow&, int)> take) const;
  /// The same for face `side` of the bounding box, 0 to 5.
  GameRow box_row(int side, Simplex corners) const;

 private:
  const Shape& solid_;
  const std::shared_ptr<const ExposedSurface> exposed_;
  const Shape& surface_;  // its boundary
  const Slope& slope(int triangle) const;

  struct KnownSlope {
    bool known = false;
    Slope slope;
  };
  mutable std::vector<KnownSlope> slopes_;  // of the requested triangles
};

}  // namespace clench
