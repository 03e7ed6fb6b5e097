// Shape b in the frame of shape a: the exact part of every query on a pair. For the queries of this
// module only.
#pragma once
#include <algorithm>
#include <vector>

#include "clench/base/watched.h"
#include "clench/geometry/query/triangle.h"
#include "clench/geometry/tree/shape.h"
#include "clench/geometry/tree/walk.h"
#include "clench/math/pose.h"

namespace clench {

/// Rounding error of a distance at points within the bounds, or no farther from the origin than p
/// [m]
double rounding_of(const Bounds& bounds, const Eigen::Vector3d& p);

/// fingerprint of a pair of shapes: equal for equal meshes in the same order
inline uint64_t fingerprint(const Shape& a, const Shape& b) {
  return Hasher::mix(a.hash()) ^ b.hash();
}

/// Upper bound on the displacement of any point of b between two poses, rounding of coordinates
/// included [m]
double motion_bound(const Shape& b, const Pose& from, const Pose& to);

/// X_AB with its quaternion normalized.
/// throws  Error if the quaternion is far from unit, or the position is not finite or too far
Pose checked_pose(const Pose& X_AB);

struct PairCache;

/// All pair queries transform corners by the same arithmetic.
class Placement {
 public:
  /// throws Error if the pose is invalid
  Placement(const Shape& a, const Shape& b, const Pose& X_AB);

  Corners corners_a(int triangle) const { return mesh_a_.corners(triangle); }
  Corners corners_b(int triangle) const {
    Corners c = mesh_b_.corners(triangle);
    for (Eigen::Vector3d& p : c) p = to_a(p);
    return c;
  }
  Eigen::Vector3d to_a(const Eigen::Vector3d& p_B) const { return rotation_ * p_B + position_; }
  Eigen::Vector3d to_b(const Eigen::Vector3d& p_A) const {
    return rotation_.transpose() * (p_A - position_);
  }
  /// computes exact distances of pairs and passes each to take(pair, closest), in order
  template <class Take>
  void measure(const std::vector<NearPair>& pairs, Take&& take) const;
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Eigen::Vector3d& position() const { return position_; }
  const TreePair& trees() const { return trees_; }
  double rounding() const { return trees_.rounding; }
  /// Can it be shown quickly that the solids are farther apart than reach [m]? Starts with the
  /// cached direction.
  bool clearly_apart(double reach, PairCache* cache = nullptr) const;

 private:
  const Mesh &mesh_a_, &mesh_b_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d position_;
  TreePair trees_;
};

template <class Take>
void Placement::measure(const std::vector<NearPair>& pairs, Take&& take) const {
  Corners a[8], b[8];
  Closest closest[8];
  // most triangles occur in several pairs
  int kept[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  Corners kept_b[8];
  StopCheck check(512);
  for (size_t begin = 0; begin < pairs.size(); begin += 8) {
    check();
    const size_t count = std::min<size_t>(8, pairs.size() - begin);
    for (size_t i = 0; i < count; ++i) {
      const auto [triangle_a, triangle_b] = pairs[begin + i];
      a[i] = corners_a(triangle_a);
      const int slot = triangle_b % 8;
      if (kept[slot] != triangle_b) kept_b[slot] = corners_b(triangle_b), kept[slot] = triangle_b;
      b[i] = kept_b[slot];
    }
    triangle_pairs(a, b, static_cast<int>(count), closest);
    for (size_t i = 0; i < count; ++i) take(pairs[begin + i], closest[i]);
  }
}

}  // namespace clench
