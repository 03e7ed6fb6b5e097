#include "model/find.h"

#include <set>

#include "base/error.h"
#include "contact/contact_set.h"

namespace clench {

// every query runs on the pair in one order, so that (a, b) and (b, a) give the same bits
static BodyPair ordered(Id<Body> a, Id<Body> b) { return std::minmax(a, b); }

static Pose relative(const Body& a, const Body& b) { return a.X_WB.inverse() * b.X_WB; }

double sphere_gap(const Body& a, const Body& b) {
  const Eigen::Vector3d between = a.X_WB * a.shape->centre() - b.X_WB * b.shape->centre();
  return between.norm() - a.shape->radius() - b.shape->radius();
}

static bool pair_collides(const World& world, Id<Body> a, Id<Body> b) {
  std::tie(a, b) = ordered(a, b);
  const Body &body_a = world.body(a), &body_b = world.body(b);
  if (sphere_gap(body_a, body_b) > 0) return false;
  return colliding(*body_a.shape, *body_b.shape, relative(body_a, body_b), &world.cache(a, b));
}

// pairs of two groups that may collide, each once, in the groups' order
template <class Visit>
static void each_pair(const World& world, std::span<const Id<Body>> a, std::span<const Id<Body>> b,
                      Visit visit) {
  std::set<BodyPair> seen;
  for (const auto i : a)
    for (const auto j : b)
      if (world.may_collide(i, j) && seen.insert(ordered(i, j)).second) visit(i, j);
}

// all pairs of the world that may collide: the earlier body first
template <class Visit>
static void each_pair(const World& world, Visit visit) {
  const auto& all = world.bodies();
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = i + 1; j < all.size(); ++j)
      if (world.may_collide(all[i], all[j])) visit(all[i], all[j]);
}

std::vector<BodyPair> colliding_pairs(const World& world) {
  std::vector<BodyPair> out;
  each_pair(world, [&](Id<Body> a, Id<Body> b) {
    if (pair_collides(world, a, b)) out.emplace_back(a, b);
  });
  return out;
}

std::vector<BodyPair> colliding_pairs(const World& world, std::span<const Id<Body>> a,
                                      std::span<const Id<Body>> b) {
  std::vector<BodyPair> out;
  each_pair(world, a, b, [&](Id<Body> i, Id<Body> j) {
    if (pair_collides(world, i, j)) out.emplace_back(i, j);
  });
  return out;
}

BodyDistance distance(const World& world, std::span<const Id<Body>> a, std::span<const Id<Body>> b,
                      double limit) {
  BodyDistance best;
  best.distance = limit;
  best.p_a = best.p_b = Eigen::Vector3d::Zero();
  for (const auto i : a)
    for (const auto j : b) {
      const auto [first, second] = ordered(i, j);
      const Body &one = world.body(first), &two = world.body(second);
      if (i == j || !one.shape || !two.shape || sphere_gap(one, two) > best.distance) continue;
      const Distance d = distance(*one.shape, *two.shape, relative(one, two), best.distance,
                                  &world.cache(first, second));
      if (!(d.distance < best.distance)) continue;
      const Eigen::Vector3d p_one = one.X_WB * d.p_a, p_two = one.X_WB * d.p_b;
      best = {d.distance, i == first ? p_one : p_two, i == first ? p_two : p_one, i, j};
    }
  if (!best.a) best.distance = std::numeric_limits<double>::infinity();
  return best;
}

// which of the two owns the contact: the thing that is held, else the second
static bool first_is_held(const Body& first, const Body& second) {
  return !first.robot && second.robot;
}

static void add_contacts(const World& world, Id<Body> other, Id<Body> body,
                         std::vector<Contact>& out) {
  const auto [first, second] = ordered(other, body);
  const Body &a = world.body(first), &b = world.body(second);
  const double threshold = world.contact_threshold();
  if (sphere_gap(a, b) > threshold) return;
  const auto touches = contact_set(*a.shape, *b.shape, relative(a, b), {.threshold = threshold});
  const Friction friction = world.materials().friction(a.material, b.material);
  const ContactKind kind = friction.statics > 0 ? ContactKind::point : ContactKind::frictionless;
  for (const Touch& touch : touches) {
    const bool on_b = body == second;
    const Eigen::Vector3d n_W = a.X_WB.rotation * touch.normal_b;
    out.push_back({.body = body,
                   .other = other,
                   .p_W = a.X_WB * (on_b ? touch.p_b : touch.p_a),
                   .n_W = on_b ? n_W : Eigen::Vector3d(-n_W),
                   .gap = touch.gap,
                   .friction = friction,
                   .kind = kind});
  }
}

std::vector<Contact> contacts(const World& world) {
  std::vector<Contact> out;
  each_pair(world, [&](Id<Body> a, Id<Body> b) {
    if (first_is_held(world.body(a), world.body(b))) std::swap(a, b);
    add_contacts(world, a, b, out);
  });
  return out;
}

std::vector<Contact> contacts(const World& world, std::span<const Id<Body>> others,
                              std::span<const Id<Body>> bodies) {
  std::vector<Contact> out;
  each_pair(world, others, bodies, [&](Id<Body> a, Id<Body> b) { add_contacts(world, a, b, out); });
  return out;
}

std::string describe(const World& world, std::span<const BodyPair> pairs) {
  std::string out;
  for (const auto& [a, b] : pairs)
    out +=
        fmt::format("{}{} and {}", out.empty() ? "" : ", ", world.body(a).name, world.body(b).name);
  return out;
}

}  // namespace clench
