// Grasps composed of points, without a hand that could reach them.
#pragma once
#include "clench/base/random.h"
#include "clench/grasp/force/contact_forces.h"
#include "support/robots.h"

namespace clench::test {

/// A hand without joints and an object; points in the object frame.
struct Held {
  World world;
  Grasp grasp;
};

inline Held held(const std::vector<PointContact>& points, const Pose& X_WO = Pose()) {
  Held h;
  RobotSpec fixture;
  fixture.name = "fixture";
  fixture.base = body_spec("fixture_base", box(0.01, 0.01, 0.01));
  h.grasp.hand = h.world.add_robot(fixture, Pose::translation({9, 9, 9}));
  h.grasp.object = h.world.add_body(body_spec("thing", box(0.1, 0.1, 0.1)), BodyKind::object, X_WO);
  h.grasp.points = points;
  h.grasp.rho = 0.1;
  for (const PointContact& point : points) {
    Contact contact;
    contact.body = h.grasp.object;
    contact.other = h.world.robot(h.grasp.hand).base;
    contact.p_W = X_WO * point.p_O;
    contact.n_W = X_WO.rotation * point.n_O;
    contact.friction = {.statics = point.mu, .kinetic = point.mu};
    h.grasp.contacts.push_back(contact);
  }
  return h;
}

inline Vector6d wrench(double fx, double fy, double fz, double tx, double ty, double tz) {
  Vector6d w;
  w << fx, fy, fz, tx, ty, tz;
  return w;
}

inline PointContact contact_at(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double mu,
                               double torsion_radius = 0) {
  return {.p_O = p, .n_O = n.normalized(), .mu = mu, .torsion_radius = torsion_radius};
}

/// Two fingers on a line through the center, 0.1 m apart.
inline std::vector<PointContact> pinch(double mu, double torsion_radius = 0) {
  return {contact_at({0.05, 0, 0}, {-1, 0, 0}, mu, torsion_radius),
          contact_at({-0.05, 0, 0}, {1, 0, 0}, mu, torsion_radius)};
}

/// Random contacts on a ball of 0.05 m.
inline std::vector<PointContact> around_ball(int count, double mu, uint64_t seed,
                                             double torsion_radius = 0) {
  Random random(seed);
  std::vector<PointContact> points;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const Eigen::Vector3d out = Eigen::Vector3d(x, y, z).normalized();
    points.push_back(contact_at(0.05 * out, -out, mu, torsion_radius));
  }
  return points;
}

}  // namespace clench::test
