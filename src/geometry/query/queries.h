// Exact queries between triangle meshes; round pieces of RoundIn::all are measured by their
// formulas, and named by their first triangles. Shape b stands at X_AB in the frame of shape a;
// every result is in the frame of a. The surface of a closed mesh bounds a solid: one body inside
// another collides. All throw Error when a number is missing or infinite or a quaternion is not
// unit.
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

/// Where a pair was last measured: what moved less since than they were apart has not met.
struct PairMeasure {
  uint64_t shapes = 0;  ///< fingerprint of both
  Pose X_AB;
  double clear = 0;  ///< the solids were at least this far apart; 0 when unknown [m]
};

/// What a pair of shapes remembers between queries. It changes how fast an answer comes and no bit
/// of it: of several pairs equally near the first in the order of triangles is the answer.
struct PairCache {
  int closest_a = -1, closest_b = -1;  ///< triangles of the last closest pair
  int hit_a = -1, hit_b = -1;          ///< triangles that met, when they were last asked
  float hit_rate = 0;  ///< how often it collided of late, of those times that it was asked
  /// along which b may lie beyond a, in the frame of a, unit; zero when unknown
  Eigen::Vector3d separation = Eigen::Vector3d::Zero();
  PairMeasure measured = {};
};

/// Do the shapes touch or overlap?
bool colliding(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache = nullptr);

struct Distance {
  double distance = 0;  ///< [m]; 0 when colliding, infinity when not closer than `limit`
  Eigen::Vector3d p_a = Eigen::Vector3d::Zero();  ///< closest point on a
  Eigen::Vector3d p_b = Eigen::Vector3d::Zero();  ///< closest point on b
  int triangle_a = -1, triangle_b = -1;           ///< where p_a and p_b lie; -1 for none
};

/// Distance with witness points. Only distances below `limit` [m] are looked for, and both
/// triangles are -1 when there is none; that the shapes collide is found at any limit. When they
/// collide p_a and p_b are one point of both; when one holds the other with no surfaces meeting,
/// the triangle of the outer one is -1.
Distance distance(const Shape& a, const Shape& b, const Pose& X_AB,
                  double limit = std::numeric_limits<double>::infinity(),
                  PairCache* cache = nullptr);

/// A lower bound of the distance of the surfaces, found sooner than that: at least `part` of it, in
/// (0, 1], or `limit` when it is not below that [m], but for some 1e-5 of the shapes' extent; 0
/// when they meet or rounding does not tell them apart.
/// near  a pair of triangles where they may be nearest, -1 when unknown; where they nearly are,
///       afterwards. The same pose, limit, part and pair give the same bound
double distance_bound(const Shape& a, const Shape& b, const Pose& X_AB, double limit, double part,
                      std::array<int, 2>& near);

/// Two triangles closer than a threshold, with their closest points.
struct TrianglePair {
  int triangle_a = -1, triangle_b = -1;
  double distance = 0;  ///< [m]; 0 when they intersect
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

/// Is p inside the solid? By the winding number, so parts may overlap and faces may look inward;
/// a part inside out within another is a hollow. Open meshes contain nothing.
bool contains(const Shape& shape, const Eigen::Vector3d& p);

/// Triangles with a point closer to p than radius [m], in index order.
std::vector<int> region(const Shape& shape, const Eigen::Vector3d& p, double radius);

struct RayHit {
  double distance = 0;  ///< along the ray [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int triangle = -1;
};

/// First triangle met by the ray from `origin` along `direction` (unit), nearer than `limit` [m],
/// from either side; the lower index on a common edge. No ray slips between neighbours; a triangle
/// seen exactly edge-on is not met.
std::optional<RayHit> cast_ray(const Shape& shape, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction,
                               double limit = std::numeric_limits<double>::infinity());

}  // namespace clench
