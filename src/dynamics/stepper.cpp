#include "clench/dynamics/stepper.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/dynamics/contact/ball_contact.h"
#include "clench/dynamics/contact/sliding.h"
#include "clench/model/advance.h"
#include "clench/model/near_bodies.h"

namespace clench {

// Less than this part of a step is no time.
static constexpr double rounding = 1e-6;

Stepper::Stepper(World& world) : world_(world) { refresh(); }

// The system follows from the model, the settings, and which joints follow their DOFs.
void Stepper::refresh() {
  world_.edit_dynamics();
  std::vector<unsigned char> follows;
  for (const auto id : world_.robots()) {
    const Robot& robot = world_.robot(id);
    for (size_t j = 0; j < robot.joints.size(); ++j) {
      // joints on springs are never where their tendon is
      if (robot.dofs[robot.joints[j].dof].kind == DofKind::compliant)
        world_.set_follows_dof(id, static_cast<int>(j), false);
      follows.push_back(world_.follows_dof(id, static_cast<int>(j)));
    }
  }
  if (stamp_ == world_.model().stamp && settings_stamp_ == world_.settings().stamp &&
      follows == follows_)
    return;
  stamp_ = world_.model().stamp;
  settings_stamp_ = world_.settings().stamp;
  follows_ = std::move(follows);
  system_ = find_system(world_);
  trees_.resize(system_.trees.size());
  forces_.resize(system_.trees.size());
  tree_rows_.resize(system_.trees.size());
}

namespace {

// A step that fails or is stopped leaves the world as it was when the step began.
template <class Change>
void change_or_restore(World& world, Change change) {
  const std::shared_ptr<const Snapshot> before = world.snapshot();
  try {
    change();
  } catch (const std::exception&) {
    world.restore(*before);
    throw;
  }
}

// How far apart a pair was when it was last measured, and how far it has moved since.
bool may_have_met(const World& world, const Manifold& m, const Pose& X_AB) {
  // distances are exact but for rounding
  constexpr double certain = 0.999;
  return displacement(m.X_AB, X_AB, *world.body(m.b).shape) >= certain * m.clearance;
}

// No point of the body is faster [m/s].
double max_speed(const World& world, Id<Body> id) {
  const Twist& twist = world.dynamics()->twists[id.index];
  const Body& body = world.body(id);
  if (twist.is_zero()) return 0;
  return twist.linear.norm() +
         twist.angular.norm() * (body.shape->radius() + (body.shape->centre() - body.com).norm());
}

// By how much they turn about each other at most [rad].
double turn(const World& world, const Manifold& m, double dt) {
  const auto& twists = world.dynamics()->twists;
  return dt * (twists[m.a.index].angular.norm() + twists[m.b.index].angular.norm());
}

// The least that a body measures along an axis of its own; no way that is shorter leads through it.
double thickness(const Shape& shape) { return shape.bounds().size().minCoeff(); }

}  // namespace

double Stepper::max_travel(double dt) const {
  double travel = 0;
  for (const auto id : world_.bodies())
    if (world_.body(id).shape) travel = std::max(travel, dt * max_speed(world_, id));
  return travel;
}

// Conservative advancement, as in advance, of pairs whose distance is a ball's.
double Stepper::advance_balls(const std::vector<std::pair<int, double>>& pairs, double end,
                              Mover& mover) {
  constexpr double aim = 0.2, there = 0.3;
  const double threshold = world_.contact_threshold();
  double stop = end;
  for (const auto& [i, speed] : pairs) {
    const Manifold& m = world_.dynamics()->manifolds[i];
    double s = 0, before = std::numeric_limits<double>::infinity();
    for (int steps = 0; s < stop && steps < 1000; ++steps) {
      check_stop();
      mover.place(s);
      const double gap = ball_distance(world_, m, speed * (stop - s) + 2 * threshold);
      // one that leaves goes on
      if (gap <= there * threshold && gap < before && steps > 0) break;
      before = gap;
      s = std::min(stop, s + std::max(gap - aim * threshold, 0.05 * threshold) / speed);
    }
    stop = std::min(stop, s);
  }
  mover.place(stop);
  return stop;
}

// Until when bodies that touch do not come into each other, looked at every so often on their way:
// dt where they never do.
double Stepper::free_until(const Manifold& m, int places, double dt, Mover& mover) {
  const auto [first, second] = ordered(m.a, m.b);
  const auto is_free = [&](double s) {
    check_stop();
    mover.place(s);
    if (has_ball(world_, m)) return ball_distance(world_, m, world_.contact_threshold()) > 0;
    return distance(*world_.body(m.a).shape, *world_.body(m.b).shape,
                    relative_pose(world_, m.a, m.b), world_.contact_threshold(),
                    &world_.context().pair(first, second))
               .distance > 0;
  };
  double free = 0, met = dt;
  int k = 1;
  while (k <= places && is_free(dt * k / (places + 1))) free = dt * k++ / (places + 1);
  if (k <= places || !is_free(dt)) {
    met = dt * k / (places + 1);
    for (int i = 0; i < 6; ++i) (is_free((free + met) / 2) ? free : met) = (free + met) / 2;
  } else {
    free = dt;
  }
  mover.place(dt);
  return free;
}

// Which pairs may meet while bodies move, and what that says of the time that passes.
struct Stepper::Meetings {
  std::vector<int> suspects = {};  // manifolds that may be other ones afterwards
  std::vector<PairBound> watched = {};
  std::vector<std::pair<int, double>> balls = {};      // manifolds, and bounds of their speeds
  std::vector<std::pair<int, Manifold>> arrived = {};  // already measured where they arrive
  // time passes at least: next to none where all start with a gap, as they may meet at any time
  std::optional<double> min_time = {};
  double max_time;      // passes at most
  double overlap_time;  // after which bodies that overlap are looked at again
};

// A pair after dt: whether it has arrived without meeting, or how it has to be followed.
void Stepper::follow_pair(int number, double dt, Mover& mover, Meetings& meetings) {
  // What moves farther than so many thresholds in a step is followed all the way; others are looked
  // at where they arrive.
  constexpr double short_way = 10, max_looks = 1000;
  // Beyond the one turn the chord tells nothing of the way, beyond the other [rad] nobody follows
  // it.
  constexpr double far_turn = 0.5, whirl = 20;
  const Manifold& m = world_.dynamics()->manifolds[number];
  const Shape& shape = *world_.body(m.b).shape;
  const Pose &before = m.X_AB_end, X_AB = relative_pose(world_, m.a, m.b);
  const double threshold = world_.contact_threshold(), step = world_.dynamic_settings().step;
  // the bound holds on the whole way, which is longer than the chord of a turn
  const double turned = turn(world_, m, dt);
  const bool far = turned > far_turn;
  const double arc = far ? dt * (max_speed(world_, m.a) + max_speed(world_, m.b)) : 0;
  if (!may_have_met(world_, m, X_AB) &&
      !(far && displacement(m.X_AB, before, shape) + arc >= m.clearance))
    return;
  meetings.suspects.push_back(number);
  const double way = far ? arc : displacement(before, X_AB, shape);
  const double thin = 0.5 * std::min(thickness(*world_.body(m.a).shape), thickness(shape));
  if (m.clearance == 0) {
    // they overlap: nothing to stop, but they are looked at before one is through the other
    if (way > thin && !m.points.empty())
      meetings.overlap_time =
          std::min(meetings.overlap_time, std::max(dt * thin / way, 1e-3 * step));
    return;
  }
  const bool touching = m.clearance - displacement(m.X_AB, before, shape) <= threshold;
  const double looked_at = std::min(short_way * threshold, thin);
  Manifold there = m;
  bool arrived = way <= thin && follow_sliding(world_, there);
  if (turned > whirl) measure(world_, there), arrived = true;
  // following what touches would ask a thousand times whether it still only does
  const bool looks = !arrived && touching && way > looked_at && way <= max_looks * looked_at;
  const double free = looks ? free_until(m, static_cast<int>(way / looked_at), dt, mover) : 0;
  if (!arrived && (way <= looked_at || free == dt)) {
    measure(world_, there);
    arrived = there.clearance > 0 || free == dt;
  }
  if (arrived) {
    meetings.arrived.emplace_back(number, std::move(there));
    return;
  }
  // those within the threshold already get on, by a hundredth of a step, but not through each
  // other; less where it is known when they meet
  const double gets_on = std::min(0.01 * step, dt * thin / way);
  if (touching) meetings.min_time = std::min(meetings.min_time.value_or(dt), gets_on);
  if (looks)
    meetings.max_time = std::min(meetings.max_time, std::max(free, 0.1 * gets_on));
  else if (has_ball(world_, m))
    meetings.balls.push_back({number, 1.1 * way / dt});
  else
    meetings.watched.push_back({.a = m.a, .b = m.b, .speed = 1.1 * way / dt});
}

// How much of dt passes until the first of them meet.
double Stepper::time_until_meeting(Meetings& meetings, double dt, Mover& mover) {
  const double most = std::min(meetings.max_time, meetings.overlap_time);
  double passed = most;
  if (!meetings.balls.empty()) passed = advance_balls(meetings.balls, passed, mover);
  if (!meetings.watched.empty()) {
    int queries = 0;
    // of each pair the gap is measured at first, and some times on its way
    const int max_steps = 1000 + 10 * static_cast<int>(meetings.watched.size());
    const Advance advance = clench::advance(
        world_, meetings.watched, passed, [&](double s) { mover.place(s); }, queries, max_steps);
    passed = advance.iteration_limit
                 ? std::max(advance.s, std::min(passed, 0.01 * world_.dynamic_settings().step))
                 : advance.s;
  }
  return std::clamp(passed, std::min(most, meetings.min_time.value_or(1e-9 * dt)), most);
}

// The manifolds where bodies are now; whole: all of dt has passed.
void Stepper::measure_met(Meetings& meetings, bool whole) {
  auto& manifolds = world_.edit_dynamics().manifolds;
  if (!whole) {
    for (const int i : meetings.suspects) measure(world_, manifolds[i]);
    return;
  }
  for (auto& [i, there] : meetings.arrived) manifolds[i] = std::move(there);
  for (const auto& [i, speed] : meetings.balls) measure(world_, manifolds[i]);
  for (const PairBound& pair : meetings.watched)
    for (const int i : meetings.suspects)
      if (manifolds[i].a == pair.a && manifolds[i].b == pair.b) measure(world_, manifolds[i]);
}

double Stepper::move(double dt) {
  double passed = 0;
  change_or_restore(world_, [&] { passed = move_bodies(dt); });
  return passed;
}

void Stepper::solve(double h) {
  change_or_restore(world_, [&] {
    refresh();
    find_manifolds(world_, system_, 0);
    solve_found(h);
  });
}

double Stepper::move_bodies(double dt) {
  refresh();
  find_manifolds(world_, system_, max_travel(dt));
  DynamicState& state = world_.edit_dynamics();
  Mover mover(world_, system_);
  mover.place(dt);
  Meetings meetings{.max_time = dt, .overlap_time = dt};
  for (int i = 0; i < static_cast<int>(state.manifolds.size()); ++i) {
    check_stop();
    follow_pair(i, dt, mover, meetings);
  }
  const double passed = time_until_meeting(meetings, dt, mover);
  if (passed < meetings.overlap_time) ++state.report.impacts;
  mover.finish(passed);
  measure_met(meetings, passed >= dt);
  for (Manifold& m : state.manifolds) m.X_AB_end = relative_pose(world_, m.a, m.b);
  state.time += passed;
  // the same moments however time is divided: sums of many steps are off by rounding
  const double step = world_.dynamic_settings().step, whole = std::round(state.time / step) * step;
  if (std::abs(whole - state.time) < rounding * step) state.time = whole;
  state.whole_step = dt;
  return passed;
}

bool Stepper::step(double end) {
  const double step = world_.dynamic_settings().step;
  if (!(end - world_.time() > rounding * step)) return false;
  world_.context().progress().check();
  check_stop();
  // Steps end at multiples of the step, after an impact as well: the same ones however a time is
  // divided.
  const double now = world_.time(), next = (std::floor(now / step + rounding) + 1) * step;
  double left = std::min(next, end) - now;
  if (!(now + left > now))
    fail(ErrorKind::limit, "world: a step of {} s is no time beside the {} s that it has run", step,
         now);
  if (std::abs(left - step) < rounding * step) left = step;
  change_or_restore(world_, [&] {
    const double h = move_bodies(left);
    double& time = world_.edit_dynamics().time;
    if (std::abs(end - time) < rounding * step) time = end;
    refresh();
    solve_found(h);
  });
  return true;
}

void Stepper::run(double duration) {
  const double end = world_.time() + duration;
  while (step(end)) {
  }
}

}  // namespace clench
