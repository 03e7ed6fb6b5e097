#include "clench/planning/energy/contact_sites.h"

#include <algorithm>
#include <array>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/find.h"
#include "clench/motion/virtual_contacts.h"

namespace clench {

using Eigen::Vector3d;

ContactSites::ContactSites(const World& world, const HandAndObject& who, SiteKind kind)
    : who_(who), kind_(kind) {
  const Robot& hand = world.robot(who.hand);
  const Body& object = world.body(who.object);
  const auto refuse = [&](std::string_view why) {
    fail("energy of '{}' and '{}': {}", excerpt(hand.name), excerpt(object.name), why);
  };
  if (!object.shape) refuse("the object has no geometry");
  if (object.robot) refuse("the object is a part of a robot");
  if (kind == SiteKind::preset) {
    for (const VirtualContactSpec& c : virtual_contacts(world, who.hand))
      sites_.push_back({.body = hand.body_of(c.link),
                        .X_LC = c.X_LC,
                        .mu = c.mu,
                        .edges = c.edges,
                        .n_L = turned(c.X_LC.rotation, Vector3d::UnitZ())});
    if (sites_.empty()) refuse("the hand has no virtual contacts");
    places_.resize(sites_.size());
  } else {
    for (const Id<Body> id : world.bodies_of(who.hand))
      if (world.body(id).shape) sites_.push_back({.body = id, .X_LC = {}, .edges = {}});
    if (sites_.empty()) refuse("the hand has no geometry");
  }
}

void ContactSites::attend(const World& world) {
  X_OW_ = world.pose(who_.object).inverse();
  if (kind_ == SiteKind::live) return;
  for (size_t i = 0; i < sites_.size(); ++i) {
    const ContactSite& site = sites_[i];
    const Pose& X_WL = world.pose(site.body);
    const Vector3d p_W = turned(X_WL.rotation, site.X_LC.position) + X_WL.position;
    places_[i].p_O = turned(X_OW_.rotation, p_W) + X_OW_.position;
  }
}

double ContactSites::min_distance(const World& world, int i) const {
  if (kind_ == SiteKind::live) return 0;
  const Bounds& bounds = world.body(who_.object).shape->bounds();
  const Vector3d& p = places_[i].p_O;
  const double out = (bounds.low - p).cwiseMax(p - bounds.high).cwiseMax(0).norm();
  return std::max(0.0, out - 1e-12 * p.norm());
}

SiteDistance ContactSites::measure(World& world, int i) {
  if (kind_ == SiteKind::live) return measure_live(world, i);
  auto& [p_O, triangle] = places_[i];
  const ClosestPoint near = closest_point(*world.body(who_.object).shape, p_O, triangle);
  triangle = near.triangle;
  SiteDistance out;
  out.p = p_O;
  out.n = turned(X_OW_.rotation, turned(world.pose(sites_[i].body).rotation, sites_[i].n_L));
  out.q = near.point;
  out.u = out.n;
  out.triangle = near.triangle;
  out.distance = near.distance;
  if (near.distance > 0) out.u = (out.q - out.p) / near.distance;
  return out;
}

SiteDistance ContactSites::measure_live(World& world, int i) {
  const std::array link{sites_[i].body}, object{who_.object};
  const BodyDistance near = clench::distance(world, link, object, infinite, &world.context());
  SiteDistance out;
  out.distance = near.distance;
  out.p = X_OW_ * near.p_a;
  out.q = X_OW_ * near.p_b;
  out.u = near.distance > 0 ? Vector3d((out.q - out.p) / near.distance) : Vector3d::UnitZ();
  // the nearest points of two smooth surfaces face each other
  out.n = out.u;
  return out;
}

}  // namespace clench
