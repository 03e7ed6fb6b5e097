#include "grasp/grasp.h"

#include <cmath>

#include "base/error.h"

namespace clench {

Grasp measure_grasp(const World& world, Id<Robot> hand, Id<Body> object,
                    const GraspOptions& options) {
  const Body& held = world.body(object);
  const std::string& hand_name = world.robot(hand).name;
  const auto refuse = [&](const std::string& why) {
    fail("grasp of {} by {}: {}", held.name, hand_name, why);
  };
  if (held.robot)
    refuse(fmt::format("{} is a part of {}", held.name, world.robot(held.robot).name));
  if (options.edges < 3 || options.edges > most_edges)
    refuse(fmt::format("edges must be 3 to {}, got {}", most_edges, options.edges));
  if (options.rho && !(std::isfinite(*options.rho) && *options.rho > 0))
    refuse(fmt::format("rho must be > 0 [m], got {}", *options.rho));

  Grasp grasp;
  grasp.hand = hand;
  grasp.object = object;
  grasp.com = held.com;
  grasp.edges = options.edges;
  // a body without extent has no contacts either: any length will do
  const double radius = held.max_radius();
  grasp.rho = options.rho.value_or(radius > 0 ? radius : 1);

  const auto parts = world.bodies_of(hand);
  grasp.contacts = contacts(world, parts, std::span(&object, 1));
  const Pose X_OW = held.X_WB.inverse();
  for (const Contact& contact : grasp.contacts)
    grasp.points.push_back({.p_O = X_OW * contact.p_W,
                            .n_O = (X_OW.rotation * contact.n_W).normalized(),
                            .mu = contact.friction.statics});
  return grasp;
}

WrenchSpace wrench_space(const Grasp& grasp) {
  const ConeOptions options{.edges = grasp.edges, .rho = grasp.rho, .p_OM = grasp.com};
  std::vector<Wrenches> wrenches;
  for (const PointContact& point : grasp.points) wrenches.push_back(cone_wrenches(point, options));
  return WrenchSpace(std::move(wrenches));
}

}  // namespace clench
