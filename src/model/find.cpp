#include "clench/model/find.h"

#include <algorithm>
#include <optional>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/contact/contact_set.h"

namespace clench {

// the caller's context, or one of its own
class Remember {
 public:
  Remember(const World& world, QueryContext* context)
      : context_(context ? *context : own_.emplace()) {
    context_.attend(world.lineage(), world.model());
  }
  QueryContext& operator*() { return context_; }
  QueryContext* operator->() { return &context_; }

 private:
  std::optional<QueryContext> own_;
  QueryContext& context_;
};

static bool pair_collides(const World& world, const BodyPair& p, PairCache& cache) {
  const auto [a, b] = ordered(p.first, p.second);
  return colliding(*world.body(a).shape, *world.body(b).shape, relative_pose(world, a, b), &cache);
}
static PairCache& cache_of(const BodyPair& p, QueryContext& context) {
  const auto [a, b] = ordered(p.first, p.second);
  return context.pair(a, b);
}

static std::vector<BodyPair> colliding_of(const World& world, std::vector<BodyPair> pairs,
                                          QueryContext& context) {
  std::erase_if(pairs,
                [&](const BodyPair& p) { return !pair_collides(world, p, cache_of(p, context)); });
  return pairs;
}

std::vector<BodyPair> colliding_pairs(const World& world, QueryContext* context) {
  Remember memory(world, context);
  return colliding_of(world, near_bodies(world, 0, *memory), *memory);
}

std::vector<BodyPair> colliding_pairs(const World& world, std::span<const Id<Body>> a,
                                      std::span<const Id<Body>> b, QueryContext* context) {
  Remember memory(world, context);
  return colliding_of(world, near_bodies(world, a, b, 0, *memory), *memory);
}

bool collides(const World& world, QueryContext* context) {
  Remember memory(world, context);
  return any_near(world, *memory, [&](const BodyPair& pair, PairCache& cache) {
    return pair_collides(world, pair, cache);
  });
}

bool collides(const World& world, std::span<const Id<Body>> bodies, QueryContext* context) {
  Remember memory(world, context);
  const auto among = [&](Id<Body> id) { return std::ranges::find(bodies, id) != bodies.end(); };
  return any_near(world, *memory, [&](const BodyPair& pair, PairCache& cache) {
    return (among(pair.first) || among(pair.second)) && pair_collides(world, pair, cache);
  });
}

BodyDistance distance(const World& world, std::span<const Id<Body>> a, std::span<const Id<Body>> b,
                      double limit, QueryContext* context) {
  Remember memory(world, context);
  BodyDistance best;
  best.distance = limit;
  best.p_a = best.p_b = Eigen::Vector3d::Zero();
  for (const auto i : a)
    for (const auto j : b) {
      const auto [first, second] = ordered(i, j);
      const Body &one = world.body(first), &two = world.body(second);
      if (i == j || !one.shape || !two.shape || sphere_gap(world, first, second) > best.distance)
        continue;
      const Distance d = distance(*one.shape, *two.shape, relative_pose(world, first, second),
                                  best.distance, &memory->pair(first, second));
      if (!(d.distance < best.distance)) continue;
      const Pose& X_W = world.pose(first);
      const Eigen::Vector3d p_one = X_W * d.p_a, p_two = X_W * d.p_b;
      best = {d.distance, i == first ? p_one : p_two, i == first ? p_two : p_one, i, j};
    }
  if (!best.a) best.distance = std::numeric_limits<double>::infinity();
  return best;
}

// which of the two owns the contact: the thing that is held, else the second
static bool first_is_held(const Body& first, const Body& second) {
  return !first.robot && second.robot;
}

static Elasticity elasticity(const Body& body) {
  return {.modulus = body.elastic_modulus, .layer = body.soft_layer, .poisson = body.poisson_ratio};
}

// Gives each point's force of the last step to one touch: that on the same features, else the nearest.
static void add_forces(const Manifold& manifold, const std::vector<Touch>& touches, const Pose& X_WA, bool on_b,
                       std::span<Contact> contacts) {
  constexpr double near = 1e-3;
  std::vector<bool> taken(touches.size());
  for (const ManifoldPoint& p : manifold.points) {
    size_t best = touches.size();
    double nearest = near;
    for (size_t i = 0; i < touches.size(); ++i) {
      if (taken[i]) continue;
      const bool same = p.feature_a == touches[i].feature_a && p.feature_b == touches[i].feature_b;
      const double d = same ? 0 : (p.p_a - touches[i].p_a).norm();
      if (d < nearest) best = i, nearest = d;
      if (same) break;
    }
    if (best == touches.size()) continue;
    taken[best] = true;
    const Eigen::Vector3d force = X_WA.rotation * p.force;
    contacts[best].force_W = on_b ? force : Eigen::Vector3d(-force);
    contacts[best].torsion = p.torsion;
  }
}

static const Manifold* manifold_of(const World& world, Id<Body> a, Id<Body> b) {
  if (!world.dynamics()) return nullptr;
  for (const Manifold& m : world.dynamics()->manifolds)
    if (m.a == a && m.b == b) return &m;
  return nullptr;
}

static void add_contacts(const World& world, Id<Body> other, Id<Body> body,
                         std::vector<Contact>& out) {
  const auto [first, second] = ordered(other, body);
  const Body &a = world.body(first), &b = world.body(second);
  const double threshold = world.contact_threshold();
  if (sphere_gap(world, first, second) > threshold) return;
  const Pose X_AB = relative_pose(world, first, second);
  const Pose& X_WA = world.pose(first);
  const auto touches = contact_set(*a.shape, *b.shape, X_AB, {.threshold = threshold});
  const Friction friction = world.materials().friction(a.material, b.material);
  const bool soft = friction.statics > 0 && (a.elastic_modulus || b.elastic_modulus);
  const ContactKind kind = soft                   ? ContactKind::soft
                           : friction.statics > 0 ? ContactKind::point
                                                  : ContactKind::frictionless;
  std::vector<SoftSitePtr> sites(touches.size());
  if (soft) sites = soft_sites(a.shape, b.shape, X_AB, elasticity(a), elasticity(b), touches);
  const bool on_b = body == second;
  const Manifold* manifold = manifold_of(world, first, second);
  for (size_t i = 0; i < touches.size(); ++i) {
    const Touch& touch = touches[i];
    const Eigen::Vector3d n_W = X_WA.rotation * touch.normal_b;
    out.push_back({.body = body,
                   .other = other,
                   .p_W = X_WA * (on_b ? touch.p_b : touch.p_a),
                   .n_W = on_b ? n_W : Eigen::Vector3d(-n_W),
                   .gap = touch.gap,
                   .feature = on_b ? touch.feature_b : touch.feature_a,
                   .other_feature = on_b ? touch.feature_a : touch.feature_b,
                   .friction = friction,
                   .kind = kind,
                   .site = sites[i],
                   .X_WA = X_WA,
                   .body_is_b = on_b});
  }
  if (manifold) add_forces(*manifold, touches, X_WA, on_b, std::span(out).last(touches.size()));
}

std::vector<Contact> contacts(const World& world, QueryContext* context) {
  Remember memory(world, context);
  std::vector<Contact> out;
  for (auto [a, b] : near_bodies(world, world.contact_threshold(), *memory)) {
    memory->progress().check();
    if (first_is_held(world.body(a), world.body(b))) std::swap(a, b);
    add_contacts(world, a, b, out);
  }
  return out;
}

std::vector<Contact> contacts(const World& world, std::span<const Id<Body>> others,
                              std::span<const Id<Body>> bodies, QueryContext* context) {
  Remember memory(world, context);
  std::vector<Contact> out;
  for (const auto& [a, b] :
       near_bodies(world, others, bodies, world.contact_threshold(), *memory)) {
    memory->progress().check();
    add_contacts(world, a, b, out);
  }
  return out;
}

std::string describe(const World& world, std::span<const BodyPair> pairs) {
  std::vector<std::string> names;
  for (const auto& [a, b] : pairs)
    names.push_back(
        fmt::format("{} and {}", excerpt(world.body(a).name), excerpt(world.body(b).name)));
  return name_list(names);
}

}  // namespace clench
