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
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]
};

/// A sphere that contains the corners.
Sphere sphere_about(Simplex corners);

/// A point against a solid.
struct Probe {
  double distance = 0;  ///< to the surface [m]
  int triangle = -1;    ///< the nearest
  bool inside = false;
  /// of the ball about the point, nothing is deeper
  double deepest(double radius) const { return (inside ? distance : -distance) + radius; }
};

/// Unit inward normal of a triangle whose corners run counter-clockwise from outside, and the error
/// of a component of it; zero for a triangle without area.
struct Slope {
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();
  double error = 0;
};

Slope slope_of(const Shape& shape, int triangle);

/// Triangles of a surface on which the nearest points lie of all points of a ball that are inside.
struct NearTriangles {
  static constexpr int capacity = 256;
  std::array<int, capacity> triangles;
  int count = 0;
  bool complete = false;  ///< false: not looked for, or more than fit
  double reach = 0;       ///< of the centre, where the points lie [m]

  std::span<const int> list() const { return {triangles.data(), static_cast<size_t>(count)}; }
};

/// Triangles are those of the surface.
class DepthField {
 public:
  /// solid  closed
  DepthField(const Shape& solid, const Progress& progress);

  const Shape& solid() const { return solid_; }
  /// the triangle of the solid that one of the surface is a part of
  int triangle_of_solid(int triangle) const {
    return exposed_->shape ? exposed_->triangles[triangle] : triangle;
  }
  /// Surface point nearest to p.   seed  a triangle likely to be near, -1 for none
  ClosestPoint nearest(const Eigen::Vector3d& p, int seed = -1) const {
    return closest_point(surface_, p, seed);
  }
  bool holds(const Eigen::Vector3d& p) const { return contains(solid_, p); }
  Probe probe(const Eigen::Vector3d& p, int seed = -1) const;
  /// centre  the probe of the ball's centre
  void find_near(const Sphere& ball, const Probe& centre, NearTriangles& out) const;
  /// Is it certain that the depth has no local maximum in the simplex? True where it increases
  /// along one direction all over the part of the simplex inside.
  bool rises(Simplex corners, const Sphere& ball, const NearTriangles& near) const;

  /// Values at the corners whose linear interpolation is nowhere in the simplex below the depth.
  GameRow row(int triangle, Simplex corners) const;
  /// The same of the few triangles near the simplex, passed to take(row, triangle): the signed
  /// distance from the plane of a triangle where nothing near is in front of it, and the distance
  /// from several triangles where these bound a convex part of the outside.
  void local_rows(Simplex corners, const Sphere& ball, const NearTriangles& near,
                  FunctionRef<void(const GameRow&, int)> take) const;
  /// The same of the bounding box's face number `side`, 0 to 5.
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
  mutable std::vector<KnownSlope> slopes_;  // of the triangles that were asked for
};

}  // namespace clench
