#include "clench/geometry/tree/make_bounding_polytope.h"

#include <algorithm>
#include <array>

namespace clench {

using Eigen::Vector3d;

namespace {

class PointBundles {
 public:
  // a sample of the points
  PointBundles(const std::vector<Vector3d>& points, size_t step) {
    const size_t count = (points.size() + step - 1) / step;
    bundles_.resize((count + lane_count - 1) / lane_count);
    for (size_t i = 0; i < lane_count * bundles_.size(); ++i)
      for (int m = 0; m < 3; ++m)
        bundles_[i / lane_count].at[m][i % lane_count] =
            static_cast<float>(points[i < count ? i * step : 0][m]);
  }
  Vector3d farthest_along(const Vector3d& n, double* height = nullptr) const {
    const Eigen::Vector3f single = n.cast<float>();
    const FarPoint far = farthest_point<FloatLanes>(
        bundles_.data(), static_cast<int>(bundles_.size()), {single.x(), single.y(), single.z()});
    if (height) *height = far.height;
    return {far.at.x, far.at.y, far.at.z};
  }

 private:
  std::vector<PointBundle> bundles_;
};

// A box whose corners are cut off, the one farthest from the points first, while there is space.
class PolytopeCutter {
 public:
  PolytopeCutter(const std::vector<Vector3d>& points, const Eigen::Matrix3d& axes)
      : points_(points, 1), sample_(points, points.size() / 512 + 1) {
    double high[2][3], size = 0;
    for (int k = 0; k < 3; ++k) {
      points_.farthest_along(axes.col(k), &high[1][k]);
      points_.farthest_along(-axes.col(k), &high[0][k]);
      size = std::max(size, high[1][k] + high[0][k]);
    }
    for (int i = 0; i < 8; ++i) {
      Corner corner;
      for (int k = 0; k < 3; ++k) {
        const int side = i >> k & 1;
        corner.at += (side ? high[1][k] : -high[0][k]) * axes.col(k);
        corner.planes[k] = 2 * k + side;
      }
      find_excess(corner);
      corners_.push_back(corner);
    }
    fine_ = 1e-3 * size;
  }

  std::vector<Vector3d> corners() {
    // cutting off a corner creates three, or more
    while (corners_.size() + 2 <= BoundingPolytope::max_corners) {
      const auto worst =
          std::max_element(corners_.begin(), corners_.end(),
                           [](const Corner& x, const Corner& y) { return x.excess < y.excess; });
      if (!(worst->excess > fine_)) break;
      if (!cut(*worst)) worst->excess = 0;
    }
    std::vector<Vector3d> out;
    for (const Corner& corner : corners_) out.push_back(corner.at);
    return out;
  }

 private:
  // intersection of three planes; if more planes intersect there, some corners coincide
  struct Corner {
    Vector3d at = Vector3d::Zero();
    std::array<int, 3> planes{};
    Vector3d out = Vector3d::Zero();  // away from the points, unit
    double excess = 0;                // its distance beyond them

    bool on(int plane) const { return std::ranges::find(planes, plane) != planes.end(); }
  };

  // From approximately the nearest point of their hull.
  // source  Gilbert (1966), an iterative procedure for the minimum of a quadratic form on a convex
  //         set
  void find_excess(Corner& corner) const {
    Vector3d to = corner.at - sample_.farthest_along(corner.at);
    for (int i = 0; i < 8; ++i) {
      const Vector3d step = corner.at - sample_.farthest_along(to) - to;
      const double squared = step.squaredNorm();
      if (!(squared > 0)) break;
      to += std::clamp(-to.dot(step) / squared, 0.0, 1.0) * step;
    }
    corner.excess = 0;
    const double length = to.norm();
    if (!(length > 0)) return;
    double height;
    corner.out = to / length;
    sample_.farthest_along(corner.out, &height);
    corner.excess = corner.at.dot(corner.out) - height;
  }

  // cuts off what lies beyond the points on the corner's side, if there is space for the new
  // corners
  bool cut(const Corner& worst) {
    const Vector3d n = worst.out;
    double offset;
    points_.farthest_along(n, &offset);
    std::vector<Corner> left, gone;
    for (const Corner& corner : corners_)
      (corner.at.dot(n) > offset ? gone : left).push_back(corner);
    const size_t old = left.size();
    for (const Corner& from : gone)
      for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < old; ++i) {
          // along an edge: both are on its planes
          const int p = from.planes[k], q = from.planes[(k + 1) % 3];
          if (!left[i].on(p) || !left[i].on(q)) continue;
          const double above = from.at.dot(n) - offset, below = offset - left[i].at.dot(n);
          Corner corner;
          corner.at = from.at + above / (above + below) * (left[i].at - from.at);
          corner.planes = {p, q, plane_count_};
          left.push_back(corner);
        }
    if (gone.empty() || left.size() == old || left.size() > BoundingPolytope::max_corners)
      return false;
    for (size_t i = old; i < left.size(); ++i) find_excess(left[i]);
    corners_ = std::move(left);
    ++plane_count_;
    return true;
  }

  const PointBundles points_, sample_;
  std::vector<Corner> corners_;
  int plane_count_ = 6;
  double fine_ = 0;
};

}  // namespace

BoundingPolytope make_bounding_polytope(const std::vector<Vector3d>& points,
                                        const Eigen::Matrix3d& axes) {
  const std::vector<Vector3d> corners = points.size() <= BoundingPolytope::max_corners
                                            ? points
                                            : PolytopeCutter(points, axes).corners();
  BoundingPolytope out;
  out.bundles = (static_cast<int>(corners.size()) + lane_count - 1) / lane_count;
  for (int i = 0; i < BoundingPolytope::max_corners; ++i) {
    const Vector3d& p = corners[i < static_cast<int>(corners.size()) ? i : 0];
    for (int m = 0; m < 3; ++m)
      out.corners[i / lane_count].at[m][i % lane_count] = static_cast<float>(p[m]);
  }
  return out;
}

}  // namespace clench
