#include "clench/model/raycast.h"

#include "clench/geometry/query/queries.h"

namespace clench {

using Eigen::Vector3d;

std::optional<WorldHit> raycast(const World& world, const Vector3d& origin,
                                const Vector3d& direction, double reach) {
  std::optional<WorldHit> nearest;
  for (const Id<Body> id : world.bodies()) {
    const Body& body = world.body(id);
    if (!body.shape) continue;
    const Pose& X_WB = world.pose(id);
    const Pose X_BW = X_WB.inverse();
    const auto hit = cast_ray(*body.shape, X_BW * origin, X_BW.rotation * direction,
                              nearest ? nearest->distance : reach);
    if (!hit) continue;
    const auto corners = body.shape->mesh().corners(hit->triangle);
    const Vector3d n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    nearest = WorldHit{id, hit->triangle, hit->distance, X_WB * hit->point, X_WB.rotation * n};
  }
  return nearest;
}

}  // namespace clench
