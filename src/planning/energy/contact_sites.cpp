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
      sites_.push_back({.body = hand.body_of(c.link), .X_LC = c.X_LC, .mu = c.mu, .edges = c.edges});
    if (sites_.empty()) refuse("the hand has no virtual contacts");
  } else {
    for (const Id<Body> id : world.bodies_of(who.hand))
      if (world.body(id).shape) sites_.push_back({.body = id, .X_LC = {}, .edges = {}});
    if (sites_.empty()) refuse("the hand has no geometry");
  }
}

void ContactSites::attend(World& world) { X_OW_ = world.pose(who_.object).inverse(); }

Vector3d ContactSites::position(const World& world, int i) const {
  return X_OW_ * (world.pose(sites_[i].body) * sites_[i].X_LC.position);
}

double ContactSites::min_distance(const World& world, int i) const {
  if (kind_ == SiteKind::live) return 0;
  const Bounds& bounds = world.body(who_.object).shape->bounds();
  const Vector3d p = position(world, i);
  const double out = (bounds.low - p).cwiseMax(p - bounds.high).cwiseMax(0).norm();
  return std::max(0.0, out - 1e-12 * p.norm());
}

SiteDistance ContactSites::measure(World& world, int i) {
  if (kind_ == SiteKind::live) return measure_live(world, i);
  ContactSite& site = sites_[i];
  const Pose& X_WL = world.pose(site.body);
  SiteDistance out;
  out.p = position(world, i);
  out.n = turned(X_OW_.rotation,
                 turned(X_WL.rotation, turned(site.X_LC.rotation, Vector3d::UnitZ())));
  const ClosestPoint near = closest_point(*world.body(who_.object).shape, out.p, site.triangle);
  site.triangle = near.triangle;
  out.q = near.point;
  out.triangle = near.triangle;
  out.distance = near.distance;
  out.u = near.distance > 0 ? Vector3d((out.q - out.p) / near.distance) : out.n;
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
