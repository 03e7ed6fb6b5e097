#include "clench/dynamics/contact/ball_contact.h"

#include <algorithm>

#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "clench/model/near_bodies.h"

namespace clench {

namespace {

// the ball and the surface that it meets, all in the frame of that one
struct Meeting {
  const Shape* surface;
  const Sphere* ball;
  Eigen::Vector3d centre;
  std::optional<Sphere> other;  // when the surface is a ball's, too
  bool ball_is_b;
};

Meeting meeting_of(const World& world, const Manifold& m) {
  const Shape &a = *world.body(m.a).shape, &b = *world.body(m.b).shape;
  const Pose X_AB = relative_pose(world, m.a, m.b);
  if (b.ball()) return {&a, &*b.ball(), X_AB * b.ball()->centre, a.ball(), true};
  return {&b, &*a.ball(), X_AB.inverse() * a.ball()->centre, std::nullopt, false};
}

}  // namespace

bool has_ball(const World& world, const Manifold& m) {
  return world.body(m.a).shape->ball() || world.body(m.b).shape->ball();
}

double ball_distance(const World& world, const Manifold& manifold, double limit) {
  const Meeting m = meeting_of(world, manifold);
  if (m.other)
    return std::min(limit, (m.centre - m.other->centre).norm() - m.other->radius - m.ball->radius);
  const double far = (m.centre - m.surface->centre()).norm() - m.surface->radius() - m.ball->radius;
  if (far >= limit) return limit;
  const double distance = closest_point(*m.surface, m.centre).distance;
  return std::min(limit, (contains(*m.surface, m.centre) ? -distance : distance) - m.ball->radius);
}

std::vector<ManifoldPoint> ball_points(const World& world, const Manifold& manifold,
                                       double threshold) {
  const Meeting m = meeting_of(world, manifold);
  const double radius = m.ball->radius;
  struct Near {
    Eigen::Vector3d point;
    double distance;
    int triangle;
  };
  std::vector<Near> near;
  if (m.other) {
    const Eigen::Vector3d between = m.centre - m.other->centre;
    const double d = between.norm();
    if (d > 0 && d <= m.other->radius + radius + threshold)
      near.push_back({m.other->centre + m.other->radius / d * between, d - m.other->radius, 0});
  } else {
    for (const int triangle : region(*m.surface, m.centre, radius + threshold)) {
      const Closest closest = point_triangle(m.centre, m.surface->mesh().corners(triangle));
      near.push_back({closest.q, closest.distance, triangle});
    }
    // the nearest first; of what lies beside a nearer one, on the way round an edge or within a
    // face, nothing counts
    std::ranges::stable_sort(near, {}, &Near::distance);
  }
  // one whose centre has got into the other body is pushed back to where it came in
  const bool inside = !m.other && contains(*m.surface, m.centre);
  if (inside) near.resize(std::min<size_t>(near.size(), 1));
  std::vector<Near> kept;
  for (const Near& candidate : near) {
    if (candidate.distance <= 0) continue;
    const Eigen::Vector3d direction = (m.centre - candidate.point) / candidate.distance;
    // A face that meets the kept one at a point of its rim is hidden by that one's tangent plane.
    const bool hidden = std::ranges::any_of(kept, [&](const Near& k) {
      const Eigen::Vector3d normal = (m.centre - k.point) / k.distance;
      return direction.dot(normal) > 1 - 1e-9 ||
             normal.dot(candidate.point - k.point) <= 1e-9 * radius;
    });
    if (!hidden) kept.push_back(candidate);
  }
  std::vector<ManifoldPoint> out;
  const Pose X_AB = relative_pose(world, manifold.a, manifold.b), X_BA = X_AB.inverse();
  for (const Near& k : kept) {
    // from the surface to the ball's centre, or out of the surface
    const Eigen::Vector3d outward = (inside ? -1 : 1) * (m.centre - k.point) / k.distance;
    const Eigen::Vector3d on_ball = m.centre - radius * outward;
    const Feature on_surface{.kind = Feature::triangle, .first = k.triangle};
    ManifoldPoint point;
    point.gap = (inside ? -k.distance : k.distance) - radius;
    if (m.ball_is_b) {
      point.p_a = k.point;
      point.p_b = X_BA * on_ball;
      point.normal = outward;
      point.feature_a = on_surface;
    } else {
      point.p_a = X_AB * on_ball;
      point.p_b = k.point;
      point.normal = X_AB.rotation * Eigen::Vector3d(-outward);
      point.feature_b = on_surface;
    }
    out.push_back(point);
  }
  return out;
}

}  // namespace clench
