// Exact queries between triangle meshes; round pieces of RoundIn::all are measured by closed
// formulas, and identified by their first triangles. Shape b has the pose X_AB in the frame of
// shape a; all results are in the frame of a. The surface of a closed mesh bounds a solid: one body
// inside another collides. All throw Error if a number is not finite or a quaternion is not unit.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "clench/geometry/tree/shape.h"
#include "clench/math/pose.h"

namespace clench {

/// The last measurement of a pair: while the bodies have moved since then by less than their
/// distance at that time, they do not collide.
struct PairMeasure {
  uint64_t shapes = 0;  ///< fingerprint of both
  Pose X_AB;
  double clear = 0;  ///< lower bound of the distance of the solids at that time; 0: unknown [m]
};

/// Data that a pair of shapes keeps between queries. It affects the time of a query but no bit of
/// its result: of several equally near pairs the first in the order of triangles is returned.
struct PairCache {
  int closest_a = -1, closest_b = -1;  ///< triangles of the last closest pair
  int hit_a = -1, hit_b = -1;          ///< triangles that intersected in the last collision found
  float hit_rate = 0;                  ///< number of recent collisions and of recent queries
  /// direction along which b may lie beyond a, in the frame of a, unit; zero: unknown
  Eigen::Vector3d separation = Eigen::Vector3d::Zero();
  PairMeasure measured = {};
};

/// Do the shapes touch or overlap?
bool colliding(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache = nullptr);

struct Distance {
  double distance = 0;  ///< [m]; 0 if colliding, infinity if not closer than `limit`
  Eigen::Vector3d p_a = Eigen::Vector3d::Zero();  ///< closest point on a
  Eigen::Vector3d p_b = Eigen::Vector3d::Zero();  ///< closest point on b
  int triangle_a = -1, triangle_b = -1;           ///< triangles of p_a and p_b; -1: none
};

/// Distance with witness points. Only distances below `limit` [m] are searched, and both triangles
/// are -1 if there is none; collisions are found for any limit. If the shapes collide, p_a and p_b
/// are a common point; if one contains the other without intersecting surfaces, the triangle of the
/// outer one is -1.
Distance distance(const Shape& a, const Shape& b, const Pose& X_AB,
                  double limit = std::numeric_limits<double>::infinity(),
                  PairCache* cache = nullptr);

/// A lower bound of the distance of the surfaces, faster than distance(): at least `part` of it, in
/// (0, 1], or `limit` if it is not below that [m], up to about 1e-5 of the shapes' extent; 0 if
/// they intersect or rounding does not separate them.
/// near  in: a pair of triangles that may be nearest, -1: unknown; out: one that nearly is. The
///       same pose, limit, part and pair give the same bound
double distance_bound(const Shape& a, const Shape& b, const Pose& X_AB, double limit, double part,
                      std::array<int, 2>& near);

/// Two triangles closer than a threshold, with their closest points.
struct TrianglePair {
  int triangle_a = -1, triangle_b = -1;
  double distance = 0;  ///< [m]; 0 if they intersect
  Eigen::Vector3d p_a, p_b;
};

/// All pairs of triangles closer than threshold [m], ordered by (triangle_a, triangle_b).
std::vector<TrianglePair> pairs_within(const Shape& a, const Shape& b, const Pose& X_AB,
                                       double threshold);

struct ClosestPoint {
  double distance = 0;  ///< [m], to the surface; never negative
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int triangle = -1;
};

/// Surface point nearest to p. `seed`, a triangle likely to be near, saves time.
ClosestPoint closest_point(const Shape& shape, const Eigen::Vector3d& p, int seed = -1);

/// Is p inside the solid? By the winding number, so parts may overlap and faces may be reversed; a
/// part that is inside out within another is a cavity. Open meshes contain nothing.
bool contains(const Shape& shape, const Eigen::Vector3d& p);

/// Triangles with a point closer to p than radius [m], in index order.
std::vector<int> region(const Shape& shape, const Eigen::Vector3d& p, double radius);

struct RayHit {
  double distance = 0;  ///< along the ray [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int triangle = -1;
};

/// First triangle hit by the ray from `origin` along `direction` (unit), nearer than `limit` [m],
/// from either side; the lower index on a common edge. No ray passes between adjacent triangles; a
/// triangle seen exactly edge-on is not hit.
std::optional<RayHit> cast_ray(const Shape& shape, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction,
                               double limit = std::numeric_limits<double>::infinity());

}  // namespace clench
