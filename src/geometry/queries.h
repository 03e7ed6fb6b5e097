// Exact queries between triangle meshes. Shape b stands at X_AB in the frame of shape a; every result
// is in the frame of a. The surface of a closed mesh bounds a solid: one body inside another collides.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/shape.h"
#include "math/pose.h"

namespace clench {

/// What a pair of shapes remembers between queries. It changes how fast an answer comes, never the answer.
struct PairCache {
  int closest_a = -1, closest_b = -1;  ///< triangles of the last closest pair
  int hit_a = -1, hit_b = -1;          ///< triangles of the last intersection
};

/// Do the shapes touch or overlap?
bool colliding(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache = nullptr);

struct Distance {
  double distance = 0;                                 ///< [m]; 0 when colliding, infinity when not closer than `limit`
  Eigen::Vector3d p_a = Eigen::Vector3d::Zero();       ///< closest point on a
  Eigen::Vector3d p_b = Eigen::Vector3d::Zero();       ///< closest point on b
  int triangle_a = -1, triangle_b = -1;
};

/// Distance with witness points. Only distances below `limit` [m] are looked for.
Distance distance(const Shape& a, const Shape& b, const Pose& X_AB,
                  double limit = std::numeric_limits<double>::infinity(), PairCache* cache = nullptr);

/// Two triangles closer than a threshold, with their closest points.
struct TrianglePair {
  int triangle_a = -1, triangle_b = -1;
  double distance = 0;          ///< [m]; 0 when they intersect
  Eigen::Vector3d p_a, p_b;
};

/// All pairs of triangles closer than threshold [m], ordered by (triangle_a, triangle_b).
std::vector<TrianglePair> pairs_within(const Shape& a, const Shape& b, const Pose& X_AB, double threshold);

struct ClosestPoint {
  double distance = 0;                            ///< [m], to the surface; never negative
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int triangle = -1;
};

/// Surface point nearest to p. `seed`, a triangle likely to be near, saves time.
ClosestPoint closest_point(const Shape& shape, const Eigen::Vector3d& p, int seed = -1);

/// Is p inside the solid? By the winding number, so parts may overlap. Open meshes contain nothing.
bool contains(const Shape& shape, const Eigen::Vector3d& p);

/// Triangles with a point closer to p than radius [m], in index order.
std::vector<int> region(const Shape& shape, const Eigen::Vector3d& p, double radius);

struct RayHit {
  double distance = 0;  ///< along the ray [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int triangle = -1;
};

/// First triangle met by the ray from `origin` along `direction` (unit), nearer than `limit` [m].
std::optional<RayHit> cast_ray(const Shape& shape, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                               double limit = std::numeric_limits<double>::infinity());

}  // namespace clench
