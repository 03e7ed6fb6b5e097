// A ray against triangles without gaps between adjacent triangles. For the queries of this module
// only.
// source  Woop, Benthin & Wald (2013), watertight ray/triangle intersection
#pragma once
#include <algorithm>
#include <cmath>

#include "clench/geometry/query/placement.h"

namespace clench {

struct Crossing {
  /// unsure: rounding may have decided; returned only on request
  enum class Kind { miss, hit, unsure };
  Kind kind = Kind::miss;
  double distance = 0;  ///< along the ray [m]; negative behind the origin
  /// +1 if the ray leaves through the outside of the triangle, -1 if it enters
  int side = 0;
};

class Ray {
 public:
  Ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
      : origin_(origin), direction_(direction) {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3, y_ = (z_ + 2) % 3;
    shear_x_ = direction[x_] / direction[z_], shear_y_ = direction[y_] / direction[z_];
  }

  /// `doubt`: relative size of edge functions that count as unsure, 0 for none
  Crossing cross(const Corners& triangle, double doubt = 0) const {
    // with the ray as z axis: twice the areas that it forms with the three edges
    double x[3], y[3], z[3], extent = 0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = triangle[i] - origin_;
      x[i] = p[x_] - shear_x_ * p[z_], y[i] = p[y_] - shear_y_ * p[z_],
      z[i] = p[z_] / direction_[z_];
      extent = std::max(extent, p.cwiseAbs().maxCoeff());
    }
    const double u = x[1] * y[2] - y[1] * x[2], v = x[2] * y[0] - y[2] * x[0],
                 w = x[0] * y[1] - y[0] * x[1];
    const double sure = doubt * extent * extent;
    if (std::min({u, v, w}) < -sure && std::max({u, v, w}) > sure) return {};
    const double area = u + v + w, depth = u * z[0] + v * z[1] + w * z[2];
    if (doubt > 0 && (std::min({std::abs(u), std::abs(v), std::abs(w)}) <= sure ||
                      std::abs(depth) <= sure * extent))
      return {Crossing::Kind::unsure};
    if (area == 0) return {};
    return {Crossing::Kind::hit, depth / area, (area > 0) == (direction_[z_] > 0) ? 1 : -1};
  }

  /// Calls visit(triangle) for all triangles that the ray may hit within `limit`, near ones early;
  /// visit may lower `limit`, and ends the traversal by returning true.
  bool for_near_triangles(const Shape& shape, const double& limit, TriangleVisit visit) const {
    const Eigen::Vector3d from = origin_ - Eigen::Vector3d::Map(shape.tree().center());
    return for_crossed_triangles(shape.tree(), from.data(), direction_.data(),
                                 rounding_of(shape.bounds(), origin_), limit, visit);
  }

 private:
  Eigen::Vector3d origin_, direction_;
  int x_, y_, z_;  // the direction's largest coordinate is its z
  double shear_x_, shear_y_;
};

}  // namespace clench
