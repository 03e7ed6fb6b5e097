#include "clench/dynamics/move/meetings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "clench/base/watched.h"
#include "clench/dynamics/contact/manifolds.h"
#include "clench/dynamics/contact/sliding.h"
#include "clench/dynamics/move/mover.h"
#include "clench/geometry/query/round_pairs.h"
#include "clench/model/advance.h"
#include "clench/model/near_bodies.h"

namespace clench {
namespace {

// Could a pair that was apart when last measured collide on the way to X_AB?
bool may_have_met(const World& world, const Manifold& m, const Pose& X_AB) {
  // distances are exact up to rounding
  constexpr double certain = 0.999;
  return displacement(m.X_AB, X_AB, *world.body(m.b).shape) >= certain * m.clearance;
}

// Upper bound on the speed of any point of a body [m/s].
double max_speed(const World& world, Id<Body> id) {
  const Twist& twist = world.dynamics()->twists[id.index];
  const Body& body = world.body(id);
  if (twist.is_zero()) return 0;
  return twist.linear.norm() +
         twist.angular.norm() * (body.shape->radius() + (body.shape->center() - body.com).norm());
}

// Upper bound on the relative rotation of a pair [rad].
double turn(const World& world, const Manifold& m, double dt) {
  const auto& twists = world.dynamics()->twists;
  return dt * (twists[m.a.index].angular.norm() + twists[m.b.index].angular.norm());
}

// Smallest extent of a body along its axes [m]: no shorter path passes through it. For an open
// surface, the other body's extent is used.
double thickness(const Shape& shape) {
  return shape.closed() ? shape.bounds().size().minCoeff()
                        : std::numeric_limits<double>::infinity();
}

// Round solids stop when half of the gap between them, or half of the rest gap, is left: the
// contact point travels far along solids that are nearly parallel, and steps that end just before
// an overlap would leave no gap to the next one [m].
double gap_to_keep(const World& world, const Manifold& m) {
  if (!are_round(*world.body(m.a).shape, *world.body(m.b).shape, RoundIn::motion)) return 0;
  return 0.5 * std::min(m.clearance, rest_gap * world.contact_threshold());
}

// Upper bound on how far any point of a body moves in dt [m].
double max_travel(const World& world, double dt) {
  double travel = 0;
  for (const auto id : world.bodies())
    if (world.body(id).shape) travel = std::max(travel, dt * max_speed(world, id));
  return travel;
}

// Finds the pairs that may collide while bodies move, and the time until the first collision.
class Meetings {
 public:
  Meetings(World& world, Mover& mover, double dt)
      : world_(world), mover_(mover), dt_(dt), max_time_(dt), overlap_time_(dt) {}

  /// Examines a pair with everything placed at dt: either it has arrived without colliding, or it
  /// is queued for time(), with the method by which to advance it.
  void follow(int manifold);
  /// Part of dt that passes until the first collision [s].
  double time();
  /// Is it shorter than overlaps alone would require?
  bool cut_short(double time) const { return time < overlap_time_; }
  /// Updates the manifolds that may have changed, with everything placed at the end of the travel.
  /// whole  has all of dt passed?
  void measure_changed(bool whole);

 private:
  double advance_round(double end);
  double free_until(const Manifold& m, int looks, double margin);

  World& world_;
  Mover& mover_;
  double dt_;
  std::vector<int> suspects_;  // manifolds that may change
  std::vector<PairBound> watched_;
  std::vector<std::pair<int, double>> round_;      // manifolds, and bounds on their speeds [m/s]
  std::vector<std::pair<int, Manifold>> arrived_;  // measured at the end of the travel
  // minimum travel time: close to zero if all pairs start with a gap, as they may collide at any
  // time
  std::optional<double> min_time_;
  double max_time_;      // maximum travel time
  double overlap_time_;  // after which overlapping bodies are measured again
};

// Conservative advancement (see model/advance.h) of pairs with round pieces: model/advance treats
// pieces of type RoundIn::motion as triangles.
// returns  the time until the first of them collide, or `end` [s]
double Meetings::advance_round(double end) {
  constexpr double aim = 0.2, there = 0.3;
  const double threshold = world_.contact_threshold();
  double stop = end;
  for (const auto& [i, speed] : round_) {
    const Manifold& m = world_.dynamics()->manifolds[i];
    double s = 0, before = std::numeric_limits<double>::infinity();
    for (int steps = 0; s < stop && steps < 1000; ++steps) {
      check_stop();
      mover_.place(s);
      const double gap = pair_gap(world_, m, speed * (stop - s) + 2 * threshold);
      // a pair that separates does not end the step
      if (gap <= there * threshold && gap < before && steps > 0) break;
      before = gap;
      s = std::min(stop, s + std::max(gap - aim * threshold, 0.05 * threshold) / speed);
    }
    stop = std::min(stop, s);
  }
  mover_.place(stop);
  return stop;
}

// Time up to which the gap of a touching pair stays above the margin, found by `looks` queries
// along its path and a bisection; dt if it always does.
double Meetings::free_until(const Manifold& m, int looks, double margin) {
  const auto is_free = [&](double s) {
    check_stop();
    mover_.place_pair(s, m.a, m.b);
    return pair_gap(world_, m, world_.contact_threshold()) > margin;
  };
  double free = 0, met = dt_;
  int k = 1;
  while (k <= looks && is_free(dt_ * k / (looks + 1))) free = dt_ * k++ / (looks + 1);
  if (k <= looks || !is_free(dt_)) {
    met = dt_ * k / (looks + 1);
    for (int i = 0; i < 6; ++i) (is_free((free + met) / 2) ? free : met) = (free + met) / 2;
  } else {
    free = dt_;
  }
  mover_.place_pair(dt_, m.a, m.b);
  return free;
}

void Meetings::follow(int number) {
  // Pairs that move farther than this many thresholds in a step are checked along their path;
  // others only at its end.
  constexpr double short_path = 10, max_looks = 1000;
  // Pairs that turn by more than the first have a path much longer than its chord; pairs that turn
  // by more than the second are not checked along their path [rad].
  constexpr double far_turn = 0.5, whirl = 20;
  const Manifold& m = world_.dynamics()->manifolds[number];
  const Shape& shape = *world_.body(m.b).shape;
  const Pose &before = m.X_AB_end, X_AB = relative_pose(world_, m.a, m.b);
  const double threshold = world_.contact_threshold(), step = world_.dynamic_settings().step;
  // the path of a rotating pair is longer than its chord
  const double turned = turn(world_, m, dt_);
  const bool far = turned > far_turn;
  const double arc = far ? dt_ * (max_speed(world_, m.a) + max_speed(world_, m.b)) : 0;
  if (!may_have_met(world_, m, X_AB) &&
      !(far && displacement(m.X_AB, before, shape) + arc >= m.clearance))
    return;
  suspects_.push_back(number);
  const double path = far ? arc : displacement(before, X_AB, shape);
  const double thin = 0.5 * std::min(thickness(*world_.body(m.a).shape), thickness(shape));
  if (m.clearance == 0) {
    // they overlap: nothing stops them, but they are measured before one has passed through the
    // other
    if (path > thin && !m.points.empty())
      overlap_time_ = std::min(overlap_time_, std::max(dt_ * thin / path, 1e-3 * step));
    return;
  }
  const bool touching = m.clearance - displacement(m.X_AB, before, shape) <= threshold;
  const double looked_at = std::min(short_path * threshold, thin);
  Manifold there = m;
  bool arrived = path <= thin && follow_sliding(world_, there);
  if (turned > whirl) measure(world_, there), arrived = true;
  // conservative advancement of a touching pair would take a thousand queries
  const double margin = gap_to_keep(world_, m);
  bool looks = !arrived && touching && path > looked_at && path <= max_looks * looked_at;
  double free = looks ? free_until(m, static_cast<int>(path / looked_at), margin) : 0;
  if (!arrived && (path <= looked_at || free == dt_)) {
    measure(world_, there);
    arrived = there.clearance > margin || free == dt_;
    looks = looks || (!arrived && touching && margin > 0);
    if (looks && !arrived) free = free_until(m, 1, margin);
  }
  if (arrived) {
    arrived_.emplace_back(number, std::move(there));
    return;
  }
  // pairs within the threshold advance by at least a hundredth of a step, but not through each
  // other; by less if the time of their collision is known
  const double least = std::min(0.01 * step, dt_ * thin / path);
  if (touching) min_time_ = std::min(min_time_.value_or(dt_), least);
  if (looks)
    max_time_ = std::min(max_time_, std::max(free, 0.1 * least));
  else if (are_round(*world_.body(m.a).shape, *world_.body(m.b).shape, RoundIn::motion))
    round_.push_back({number, 1.1 * path / dt_});
  else
    watched_.push_back({.a = m.a, .b = m.b, .speed = 1.1 * path / dt_});
}

double Meetings::time() {
  const double most = std::min(max_time_, overlap_time_);
  double passed = most;
  if (!round_.empty()) passed = advance_round(passed);
  if (!watched_.empty()) {
    int queries = 0;
    // each pair is measured once at first, and some ten times along its path
    const int max_steps = 1000 + 10 * static_cast<int>(watched_.size());
    const Advance advance = clench::advance(
        world_, watched_, passed, [&](double s) { mover_.place(s); }, queries, max_steps);
    passed = advance.iteration_limit
                 ? std::max(advance.s, std::min(passed, 0.01 * world_.dynamic_settings().step))
                 : advance.s;
  }
  return std::clamp(passed, std::min(most, min_time_.value_or(1e-9 * dt_)), most);
}

void Meetings::measure_changed(bool whole) {
  auto& manifolds = world_.edit_dynamics().manifolds;
  if (!whole) {
    for (const int i : suspects_) measure(world_, manifolds[i]);
    return;
  }
  for (auto& [i, there] : arrived_) manifolds[i] = std::move(there);
  for (const auto& [i, speed] : round_) measure(world_, manifolds[i]);
  for (const PairBound& pair : watched_)
    for (const int i : suspects_)
      if (manifolds[i].a == pair.a && manifolds[i].b == pair.b) measure(world_, manifolds[i]);
}

}  // namespace

double move_until_meeting(World& world, const System& system, double dt) {
  find_manifolds(world, system, max_travel(world, dt));
  DynamicState& state = world.edit_dynamics();
  Mover mover(world, system);
  mover.place(dt);
  Meetings meetings(world, mover, dt);
  for (int i = 0; i < static_cast<int>(state.manifolds.size()); ++i) {
    check_stop();
    meetings.follow(i);
  }
  const double passed = meetings.time();
  if (meetings.cut_short(passed)) ++state.report.impacts;
  mover.finish(passed);
  meetings.measure_changed(passed >= dt);
  for (Manifold& m : state.manifolds) m.X_AB_end = relative_pose(world, m.a, m.b);
  return passed;
}

}  // namespace clench
