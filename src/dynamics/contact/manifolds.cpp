#include "clench/dynamics/contact/manifolds.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/contact/contact_set.h"
#include "clench/contact/near_points.h"
#include "clench/dynamics/contact/overlap.h"
#include "clench/dynamics/contact/sliding.h"
#include "clench/geometry/query/round_pairs.h"
#include "clench/model/near_bodies.h"

namespace clench {

double displacement(const Pose& X_AB, const Pose& other, const Shape& b) {
  if (X_AB == other) return 0;
  const Eigen::Vector3d moved = other * b.center() - X_AB * b.center();
  // chord of the rotation: 2 sin(angle / 2)
  const double turned = 2 * (X_AB.rotation.conjugate() * other.rotation).vec().norm();
  return moved.norm() + turned * b.radius();
}

double gap_of(const ManifoldPoint& point, const Pose& X_AB) {
  return point.normal.dot(X_AB * point.p_b - point.p_a);
}

double pair_gap(World& world, const Manifold& m, double limit) {
  const auto [first, second] = ordered(m.a, m.b);
  const Shape &a = *world.body(m.a).shape, &b = *world.body(m.b).shape;
  const Pose X_AB = relative_pose(world, m.a, m.b);
  PairCache& cache = world.context().pair(first, second);
  const double gap = are_round(a, b, RoundIn::motion)
                         ? signed_distance(a, b, X_AB, RoundIn::motion, limit, &cache).distance
                         : distance(a, b, X_AB, limit, &cache).distance;
  return std::min(gap, limit);
}

void update_gaps(const World& world, Manifold& manifold) {
  const Pose X_AB = relative_pose(world, manifold.a, manifold.b);
  for (ManifoldPoint& point : manifold.points) point.gap = gap_of(point, X_AB);
}

// The patch of a point is fitted when its torsion is first needed; until then it stores only its
// site, and its radius is 0. Points of one site share it.
static std::shared_ptr<const SoftPatch> unfitted(const SoftSite& site) {
  SoftPatch patch;
  patch.site = site;
  return std::make_shared<const SoftPatch>(std::move(patch));
}

static void fit_patch(std::vector<ManifoldPoint>& points, const ManifoldPoint& point) {
  const auto before = point.patch;
  if (before->radius > 0) return;
  const auto fitted = std::make_shared<const SoftPatch>(soft_patch(before->site));
  for (ManifoldPoint& other : points)
    if (other.patch == before) other.patch = fitted;
}

void update_torsion(std::vector<ManifoldPoint>& points) {
  constexpr double noticed = 0.05;
  for (ManifoldPoint& point : points) {
    if (!point.patch) continue;
    const double force = std::max(0.0, point.force.dot(point.normal));
    if (force == 0 || std::abs(force - point.torsion_force) <= noticed * point.torsion_force)
      continue;
    fit_patch(points, point);
    point.torsion_radius = torsion_radius(*point.patch, force);
    point.torsion_force = force;
  }
}

// Points on round pieces do not follow the bodies: a rolling body leaves them behind.
static bool is_on_round(const ManifoldPoint& p) {
  return p.feature_a.kind == Feature::round || p.feature_b.kind == Feature::round;
}

// the one on the same features, otherwise the nearest that is not matched yet, within the merge
// radius of contacts
static void inherit(std::vector<ManifoldPoint>& points, const std::vector<ManifoldPoint>& before) {
  constexpr double same = 1e-3;
  std::vector<bool> taken(before.size());
  std::vector<bool> found(points.size());
  const auto take = [&](size_t i, size_t k) {
    taken[k] = found[i] = true;
    points[i].force = before[k].force;
    points[i].torsion = before[k].torsion;
    points[i].torsion_radius = before[k].torsion_radius;
    points[i].torsion_force = before[k].torsion_force;
  };
  // if a round piece touches along a line, both ends of the line lie on the same features: of
  // several points on the same features the nearest is taken
  for (size_t i = 0; i < points.size(); ++i) {
    size_t nearest = before.size();
    const auto away = [&](size_t k) { return (points[i].p_b - before[k].p_b).squaredNorm(); };
    for (size_t k = 0; k < before.size(); ++k)
      if (!taken[k] && points[i].feature_a == before[k].feature_a &&
          points[i].feature_b == before[k].feature_b &&
          (nearest == before.size() || (is_on_round(points[i]) && away(k) < away(nearest))))
        nearest = k;
    if (nearest < before.size()) take(i, nearest);
  }
  for (size_t i = 0; i < points.size(); ++i) {
    if (found[i]) continue;
    size_t best = before.size();
    double nearest = same;
    for (size_t k = 0; k < before.size(); ++k) {
      const double d = (points[i].p_b - before[k].p_b).norm();
      if (!taken[k] && d < nearest) best = k, nearest = d;
    }
    if (best < before.size()) take(i, best);
  }
}

// Removes from the old points those that press and stick, and whose two sides are still opposite
// each other, and keeps them as points: if a facet rocks from one corner to the next both are
// needed, whereas among the new points the nearest represents all within 1 mm.
// mu  kinetic friction; points near its limit count as sliding
static std::vector<ManifoldPoint> take_pressing(std::vector<ManifoldPoint>& before,
                                                const Pose& X_AB, double threshold, double mu,
                                                const std::vector<ManifoldPoint>& fresh) {
  constexpr double opposite = 0.2;  // fraction of the threshold
  std::vector<ManifoldPoint> out;
  std::erase_if(before, [&](ManifoldPoint& p) {
    const double pressing = p.force.dot(p.normal);
    if (pressing <= 0 || is_on_round(p) || out.size() == fresh.size() ||
        (p.force - pressing * p.normal).norm() >= 0.99 * mu * pressing)
      return false;
    const auto same = [&](const ManifoldPoint& q) {
      return p.feature_a == q.feature_a && p.feature_b == q.feature_b;
    };
    if (std::ranges::any_of(fresh, same)) return false;
    p.gap = gap_of(p, X_AB);
    const Eigen::Vector3d aside = X_AB * p.p_b - p.p_a - p.gap * p.normal;
    if (p.gap <= 0 || p.gap > threshold || aside.norm() > opposite * threshold) return false;
    out.push_back(p);
    return true;
  });
  return out;
}

// The same for overlapping bodies: keeps old points that are still deep in addition to the new
// ones, which are only those of the shortest displacement that separates the bodies. A body that is
// squeezed obliquely would otherwise rock from one end to the other, and penetrate deeper each
// time.
static std::vector<ManifoldPoint> take_deep(const std::vector<ManifoldPoint>& before,
                                            const Pose& X_AB, double threshold,
                                            const std::vector<ManifoldPoint>& fresh) {
  constexpr double beside = 1e-3, opposite = 10;  // [m], fraction of the threshold
  constexpr size_t most = 4;
  std::vector<ManifoldPoint> out;
  for (ManifoldPoint p : before) {
    p.gap = gap_of(p, X_AB);
    const Eigen::Vector3d aside = X_AB * p.p_b - p.p_a - p.gap * p.normal;
    const auto near = [&](const ManifoldPoint& q) {
      return (q.p_a - p.p_a).norm() < beside || (q.p_b - p.p_b).norm() < beside;
    };
    if (p.gap < 0 && !is_on_round(p) && aside.norm() <= opposite * threshold &&
        std::ranges::none_of(fresh, near))
      out.push_back(p);
  }
  std::ranges::stable_sort(out, {}, &ManifoldPoint::gap);
  if (out.size() > most) out.resize(most);
  return out;
}

static Elasticity elasticity(const Body& body) {
  return {.modulus = body.elastic_modulus, .layer = body.soft_layer, .poisson = body.poisson_ratio};
}

// points between soft bodies transmit torsion
static void find_patches(const World& world, const Manifold& m,
                         std::vector<ManifoldPoint>& points) {
  const Body &a = world.body(m.a), &b = world.body(m.b);
  if (!a.elastic_modulus && !b.elastic_modulus) return;
  if (world.materials().friction(a.material, b.material).statics == 0) return;
  std::vector<Touch> touches;
  for (const ManifoldPoint& p : points)
    touches.push_back({.p_a = p.p_a, .p_b = m.X_AB * p.p_b, .normal_b = p.normal, .gap = p.gap});
  const auto sites = soft_sites(a.shape, b.shape, m.X_AB, elasticity(a), elasticity(b), touches);
  for (size_t i = 0; i < points.size(); ++i) {
    size_t first = 0;
    while (sites[first] != sites[i]) ++first;
    points[i].patch = first < i ? points[first].patch : unfitted(*sites[i]);
  }
}

// Directions with a larger cosine are treated as equal: 4.5e-5 rad.
static constexpr double one_direction = 1 - 1e-9;

// For a point inside a face the direction is that face's normal: so all points of the face have the
// bit-exactly same direction, whereas the direction between two points a gap apart has rounding
// errors of about 1e-11.
static Eigen::Vector3d normal_of(const Shape& a, const Shape& b, const Pose& X_AB,
                                 const Touch& touch) {
  const auto face = [](const Shape& shape, const Feature& at) {
    return face_normal(shape.mesh().corners(at.first));
  };
  Eigen::Vector3d normal = touch.normal_b;
  if (touch.feature_a.kind == Feature::triangle)
    normal = face(a, touch.feature_a);
  else if (touch.feature_b.kind == Feature::triangle)
    normal = -(X_AB.rotation * face(b, touch.feature_b));
  return normal.dot(touch.normal_b) > one_direction ? normal : touch.normal_b;
}

// Faces that lie on each other are parallel up to a tiny tilt, and touch along one face's normal at
// some points and along the other's at others; between edges that lie above each other the
// direction differs slightly from both. Sliding by v along one direction opens contacts along
// another by v times the tilt, which rigid bodies can follow at few of the points only: one normal
// is used for all.
static void share_normals(std::vector<ManifoldPoint>& points) {
  const auto share = [&](size_t i, const auto& may_lend) {
    for (size_t k = 0; k < points.size(); ++k)
      if (k != i && may_lend(k) && points[k].normal.dot(points[i].normal) > one_direction) {
        points[i].normal = points[k].normal;
        return;
      }
  };
  const auto on_face = [&](size_t k) {
    return points[k].feature_a.kind == Feature::triangle ||
           points[k].feature_b.kind == Feature::triangle;
  };
  for (size_t i = 0; i < points.size(); ++i)
    if (!on_face(i)) share(i, on_face);
  for (size_t i = 1; i < points.size(); ++i) share(i, [&](size_t k) { return k < i; });
}

// Its links may be built so that they overlap.
static bool are_of_one_robot(const World& world, const Manifold& m) {
  return world.body(m.a).robot && world.body(m.a).robot == world.body(m.b).robot;
}

// Contact of a round piece whose center lies inside the other body: it pushes the piece back to the
// surface point nearest to the center.
static std::vector<Touch> push_back_touches(const Shape& a, const Shape& b, const Pose& X_AB) {
  std::vector<Touch> out;
  const auto add = [&](const Shape& mesh, const Shape& piece_of, size_t number, const Pose& X_MP,
                       bool of_b) {
    const RoundPiece& piece = piece_of.rounds().pieces[number];
    const Eigen::Vector3d center = X_MP * piece.X_SR.position;
    if (!out.empty() || !contains(mesh, center)) return;
    const ClosestPoint near = closest_point(mesh, center);
    if (!(near.distance > 0)) return;
    const Eigen::Vector3d normal = (near.point - center) / near.distance;
    const PlacedRound round{piece.solid, X_MP * piece.X_SR};
    const Eigen::Vector3d deepest = round.farthest(-normal);
    Touch touch{near.point,
                deepest,
                normal,
                normal.dot(deepest - near.point),
                {Feature::triangle, near.triangle, -1},
                {Feature::round, static_cast<int>(number), -1}};
    if (!of_b)
      touch = {X_AB * deepest, X_AB * near.point, X_AB.rotation * Eigen::Vector3d(-normal),
               touch.gap,      touch.feature_b,   touch.feature_a};
    out.push_back(touch);
  };
  for (size_t k = 0; k < b.rounds().pieces.size(); ++k) add(a, b, k, X_AB, true);
  for (size_t k = 0; k < a.rounds().pieces.size(); ++k) add(b, a, k, X_AB.inverse(), false);
  return out;
}

// Sets the clearance.
// returns  false: the present points stay in use
static bool find_points(World& world, Manifold& m, double limit,
                        std::vector<ManifoldPoint>& points) {
  const Shape &a = *world.body(m.a).shape, &b = *world.body(m.b).shape;
  const double threshold = world.contact_threshold();
  const Pose before = m.X_AB;
  m.X_AB = relative_pose(world, m.a, m.b);
  const double gap = pair_gap(world, m, limit);
  m.clearance = std::max(0.0, gap);
  if (gap > threshold) return true;
  if (gap <= 0 && are_of_one_robot(world, m)) return are_round(a, b, RoundIn::motion);
  Pose X_AT = m.X_AB;
  std::vector<Touch> touches;
  if (gap != 0) {
    touches = contact_set(a, b, X_AT, {.threshold = threshold}, RoundIn::motion);
  } else {
    // points are reused over a short travel, and as long as one of them overlaps
    const auto inside = [&](const ManifoldPoint& p) { return gap_of(p, m.X_AB) < 0; };
    if (std::ranges::any_of(m.points, inside) && displacement(before, m.X_AB, b) <= threshold) {
      m.X_AB = before;
      return false;
    }
    // bodies placed into each other touch where they would on separating
    if (const auto out = moved_out(a, b, m.X_AB, threshold))
      touches = contact_set(a, b, X_AT = *out, {.threshold = threshold}, RoundIn::motion);
    else if (are_round(a, b, RoundIn::motion))
      touches = push_back_touches(a, b, m.X_AB);
    if (touches.empty()) return false;
  }
  const bool round = are_round(a, b, RoundIn::motion);
  for (const Touch& touch : touches) {
    points.push_back({.p_a = touch.p_a,
                      .p_b = X_AT.inverse() * touch.p_b,
                      .normal = round ? touch.normal_b : normal_of(a, b, X_AT, touch),
                      .feature_a = touch.feature_a,
                      .feature_b = touch.feature_b,
                      .gap = touch.gap});
    if (gap == 0) points.back().gap = gap_of(points.back(), m.X_AB);
  }
  return true;
}

void measure(World& world, Manifold& m) {
  check_stop();
  if (follow_sliding(world, m)) return;
  const double threshold = world.contact_threshold(), limit = manifold_reach + threshold;
  std::vector<ManifoldPoint> points;
  if (const double spheres = sphere_gap(world, m.a, m.b); spheres > limit) {
    m.X_AB = relative_pose(world, m.a, m.b);
    m.clearance = spheres;
  } else if (!find_points(world, m, limit, points)) {
    return update_gaps(world, m);
  }
  if (!points.empty()) find_patches(world, m, points);
  if (!points.empty() && !m.points.empty()) {
    const double mu =
        world.materials().friction(world.body(m.a).material, world.body(m.b).material).kinetic;
    const auto stay = m.clearance > 0 ? take_pressing(m.points, m.X_AB, threshold, mu, points)
                                      : take_deep(m.points, m.X_AB, threshold, points);
    inherit(points, m.points);
    points.insert(points.end(), stay.begin(), stay.end());
  }
  share_normals(points);
  m.points = std::move(points);
}

// true if no force can move the body
static bool is_prescribed(const System& system, System::Place place) {
  return place.tree < 0 || system.trees[place.tree].size() == 0;
}

// Two bodies on one joint of a tree never approach each other; two bodies with prescribed motion
// are not stopped by contacts.
static bool needs_no_contact(const System& system, Id<Body> a, Id<Body> b) {
  const auto p = system.place(a), q = system.place(b);
  if (is_prescribed(system, p) && is_prescribed(system, q)) return true;
  return p.tree == q.tree &&
         system.trees[p.tree].bodies[p.body].joint == system.trees[q.tree].bodies[q.body].joint;
}

static bool sweep_is_old(const World& world, const DynamicState& state, double travel) {
  if (state.sweep_model != world.model().stamp || state.sweep_settings != world.settings().stamp)
    return true;
  for (const auto id : world.bodies()) {
    const Body& body = world.body(id);
    if (body.shape &&
        displacement(state.sweep_poses[id.index], world.pose(id), *body.shape) + travel >
            state.sweep_reach / 2)
      return true;
  }
  return false;
}

void find_manifolds(World& world, const System& system, double travel) {
  DynamicState& state = world.edit_dynamics();
  if (sweep_is_old(world, state, travel)) {
    state.sweep_reach = std::max(manifold_reach, 8 * travel);
    // the measurement is outdated
    const bool changed = state.sweep_model != world.model().stamp ||
                         state.sweep_threshold != world.contact_threshold();
    std::vector<Manifold> before = std::move(state.manifolds);
    state.manifolds.clear();
    QueryContext& context = world.context();
    context.attend(world.lineage(), world.model());
    const auto less = [](const Manifold& m, const BodyPair& p) { return std::pair(m.a, m.b) < p; };
    std::ranges::sort(before, {}, [](const Manifold& m) { return std::pair(m.a, m.b); });
    for (const BodyPair& near :
         near_bodies(world, state.sweep_reach + world.contact_threshold(), context)) {
      const BodyPair pair = ordered(near.first, near.second);
      if (needs_no_contact(system, pair.first, pair.second)) continue;
      const auto found = std::lower_bound(before.begin(), before.end(), pair, less);
      if (found != before.end() && found->a == pair.first && found->b == pair.second) {
        state.manifolds.push_back(std::move(*found));
        if (changed) measure(world, state.manifolds.back());
      } else {
        state.manifolds.push_back(
            {.a = pair.first, .b = pair.second, .X_AB = {}, .X_AB_end = {}, .points = {}});
        Manifold& made = state.manifolds.back();
        measure(world, made);
        made.X_AB_end = made.X_AB;
      }
    }
    state.sweep_poses.assign(world.model().bodies.size(), {});
    for (const auto id : world.bodies()) state.sweep_poses[id.index] = world.pose(id);
    state.sweep_model = world.model().stamp;
    state.sweep_settings = world.settings().stamp;
    state.sweep_threshold = world.contact_threshold();
  }
  for (Manifold& m : state.manifolds) {
    const Pose X_AB = relative_pose(world, m.a, m.b);
    if (X_AB == m.X_AB_end) continue;
    // placed elsewhere: its old forces are no warm start
    m.points.clear();
    measure(world, m);
    m.X_AB_end = X_AB;
  }
}

void update_manifolds(World& world) {
  const double threshold = world.contact_threshold();
  for (Manifold& m : world.edit_dynamics().manifolds) {
    const double moved =
        displacement(m.X_AB, relative_pose(world, m.a, m.b), *world.body(m.b).shape);
    if (m.clearance > threshold ? moved >= m.clearance - threshold
                                : moved > follows_within * threshold)
      measure(world, m);
    else
      update_gaps(world, m);
    update_torsion(m.points);
  }
}

}  // namespace clench
