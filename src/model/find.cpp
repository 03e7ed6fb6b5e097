#include "clench/model/find.h"

#include <algorithm>
#include <optional>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/contact/contact_set.h"
#include "clench/geometry/query/round_pairs.h"

namespace clench {

// the caller's context, or a temporary one
class Remember {
 public:
  Remember(const World& world, QueryContext* context)
      : context_(context ? *context : own_.emplace()) {
    check_stop();
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
  std::erase_if(pairs, [&](const BodyPair& p) {
    check_stop();
    return !pair_collides(world, p, cache_of(p, context));
  });
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

std::vector<BodyPair> first_colliding_pairs(const World& world, size_t max, QueryContext* context) {
  Remember memory(world, context);
  return first_near(world, max, *memory, [&](const BodyPair& pair) {
    check_stop();
    PairCache cache;
    return pair_collides(world, pair, cache);
  });
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
  StopCheck check(256);
  for (const auto i : a)
    for (const auto j : b) {
      check();
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

// which of the two owns the contact: the grasped object, otherwise the second
static bool first_is_held(const Body& first, const Body& second) {
  return !first.robot && second.robot;
}

static Elasticity elasticity(const Body& body) {
  return {.modulus = body.elastic_modulus, .layer = body.soft_layer, .poisson = body.poisson_ratio};
}

static const Manifold* manifold_of(const World& world, Id<Body> a, Id<Body> b) {
  if (!world.dynamics()) return nullptr;
  for (const Manifold& m : world.dynamics()->manifolds)
    if (m.a == a && m.b == b) return &m;
  return nullptr;
}

// Does something press there, and has neither of the two been placed from outside since?
static bool presses(const World& world, const Manifold& m) {
  return std::ranges::any_of(m.points, [](const ManifoldPoint& p) { return !p.force.isZero(0); }) &&
         relative_pose(world, m.a, m.b) == m.X_AB_end;
}

// The touch of each point of the last step: that on the same features, otherwise the nearest. A
// point that presses without a touch becomes one. If a shape is round for motion only, the points
// of the step replace the touches of its triangles.
// returns  indices into touches; -1: none
static std::vector<int> match(const World& world, const Manifold& manifold, const Pose& X_AB,
                              std::vector<Touch>& touches) {
  constexpr double near = 1e-3;
  const bool press = presses(world, manifold);
  const Shape &a = *world.body(manifold.a).shape, &b = *world.body(manifold.b).shape;
  if (press && are_round(a, b, RoundIn::motion) && !are_round(a, b, RoundIn::all)) touches.clear();
  const size_t count = touches.size();
  std::vector<bool> taken(count);
  std::vector<int> out;
  for (const ManifoldPoint& p : manifold.points) {
    size_t best = count;
    double nearest = near;
    for (size_t i = 0; i < count; ++i) {
      if (taken[i]) continue;
      const bool same = p.feature_a == touches[i].feature_a && p.feature_b == touches[i].feature_b;
      const double d = same ? 0 : (p.p_a - touches[i].p_a).norm();
      if (d < nearest) best = i, nearest = d;
      if (same) break;
    }
    out.push_back(best < count ? static_cast<int>(best) : -1);
    if (best < count) taken[best] = true;
  }
  if (!press) return out;
  for (size_t k = 0; k < out.size(); ++k) {
    const ManifoldPoint& p = manifold.points[k];
    if (out[k] >= 0 || p.force.isZero(0)) continue;
    out[k] = static_cast<int>(touches.size());
    touches.push_back({.p_a = p.p_a,
                       .p_b = X_AB * p.p_b,
                       .normal_b = p.normal,
                       .gap = std::max(p.gap, 0.0),
                       .feature_a = p.feature_a,
                       .feature_b = p.feature_b});
  }
  return out;
}

// Pairs that press but whose facets are not near.
template <typename Wanted>
static void add_pressing(const World& world, const Wanted& wanted, std::vector<BodyPair>& pairs) {
  if (!world.dynamics()) return;
  for (const Manifold& m : world.dynamics()->manifolds) {
    if (!presses(world, m)) continue;
    for (const BodyPair& pair : {BodyPair{m.a, m.b}, BodyPair{m.b, m.a}})
      if (wanted(pair) && std::ranges::find(pairs, pair) == pairs.end() &&
          std::ranges::find(pairs, BodyPair{pair.second, pair.first}) == pairs.end())
        pairs.push_back(pair);
  }
}

static void add_contacts(const World& world, Id<Body> other, Id<Body> body,
                         std::vector<Contact>& out) {
  const auto [first, second] = ordered(other, body);
  const Body &a = world.body(first), &b = world.body(second);
  const double threshold = world.contact_threshold();
  const Manifold* manifold = manifold_of(world, first, second);
  if (sphere_gap(world, first, second) > threshold && !manifold) return;
  const Pose X_AB = relative_pose(world, first, second);
  const Pose& X_WA = world.pose(first);
  auto touches = contact_set(*a.shape, *b.shape, X_AB, {.threshold = threshold});
  std::vector<int> matches;
  if (manifold) matches = match(world, *manifold, X_AB, touches);
  const Friction friction = world.materials().friction(a.material, b.material);
  const bool soft = friction.statics > 0 && (a.elastic_modulus || b.elastic_modulus);
  const ContactKind kind = soft                   ? ContactKind::soft
                           : friction.statics > 0 ? ContactKind::point
                                                  : ContactKind::frictionless;
  std::vector<SoftSitePtr> sites(touches.size());
  if (soft) sites = soft_sites(a.shape, b.shape, X_AB, elasticity(a), elasticity(b), touches);
  const bool on_b = body == second;
  const size_t begin = out.size();
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
  for (size_t k = 0; k < matches.size(); ++k) {
    if (matches[k] < 0) continue;
    const ManifoldPoint& p = manifold->points[k];
    const Eigen::Vector3d force = X_WA.rotation * p.force;
    Contact& contact = out[begin + static_cast<size_t>(matches[k])];
    contact.force_W = on_b ? force : Eigen::Vector3d(-force);
    contact.torsion = p.torsion;
  }
}

std::vector<Contact> contacts(const World& world, QueryContext* context) {
  Remember memory(world, context);
  std::vector<Contact> out;
  std::vector<BodyPair> pairs = near_bodies(world, world.contact_threshold(), *memory);
  add_pressing(
      world, [](const BodyPair& pair) { return pair == ordered(pair.first, pair.second); }, pairs);
  for (auto [a, b] : pairs) {
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
  std::vector<BodyPair> pairs =
      near_bodies(world, others, bodies, world.contact_threshold(), *memory);
  const auto among = [](std::span<const Id<Body>> some, Id<Body> id) {
    return std::ranges::find(some, id) != some.end();
  };
  add_pressing(
      world,
      [&](const BodyPair& pair) { return among(others, pair.first) && among(bodies, pair.second); },
      pairs);
  for (const auto& [a, b] : pairs) {
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
