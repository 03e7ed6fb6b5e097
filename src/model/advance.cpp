#include "clench/model/advance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

// a stop is deep in the threshold, so that the whole of a patch is within it, and far above
// rounding: steps aim at the one part of the threshold, and what is below the other is there
static constexpr double aim = 0.2;
static constexpr double there = 0.3;
// a bound is at least this part of the distance, and used beyond so many thresholds
static constexpr double bound_part = 0.85, bound_beyond = 4;
// the least gap that a pair is taken to have, as a part of the threshold; 0 says that it is unknown
static constexpr double touching_gap = 1e-9;
// rounding of positions must stay this much below the threshold
static constexpr double precise = 1e-3;

namespace {

struct Advancing {
  World& world;
  double end;
  double threshold = world.contact_threshold();

  // the gap that a step must leave: a touching pair may use up half of what it has
  double keep(const PairBound& watch) const {
    return watch.touching ? std::min(aim * threshold, watch.gap / 2) : aim * threshold;
  }

  // a distance of the pair at s, or a lower bound of it that leaves the pair well apart [m]
  double measure(PairBound& watch, double s, int& queries) const {
    const Body &a = world.body(watch.a), &b = world.body(watch.b);
    const double spheres = sphere_gap(world, watch.a, watch.b);
    if (spheres > 0.1 * (a.shape->radius() + b.shape->radius())) return spheres;
    // beyond what the rest of the motion can cover, the distance is of no interest
    const double reach = watch.speed * (end - s) + 2 * threshold;
    // far from a touch most of the distance will do; a pair that was near is measured at once
    if (watch.gap == 0 || watch.gap > bound_beyond * threshold) {
      ++queries;
      const double bound =
          distance_bound(*a.shape, *b.shape, relative_pose(world, watch.a, watch.b), reach,
                         bound_part, watch.near);
      if (bound >= reach || bound > bound_beyond * threshold) return bound;
    }
    ++queries;
    const std::array one{watch.a}, other{watch.b};
    // faces that lie on each other to rounding come apart from there as from a gap
    const double gap = distance(world, one, other, reach, &world.context()).distance;
    return std::clamp(gap, touching_gap * threshold, reach);
  }

  // measures the pair at s.   returns whether it stops the motion there
  bool stops(PairBound& watch, double s, int& queries) const {
    const double gap = measure(watch, s, queries);
    const bool first = watch.gap == 0;
    const bool closing = !first && gap < watch.gap;
    watch.gap = gap;
    if (first && s == 0) watch.touching = gap <= threshold;
    if (watch.touching && gap > 2 * threshold) watch.touching = false;
    if (watch.touching) return closing && gap <= nearly_closed * threshold;
    return gap <= there * threshold || (gap <= threshold && !first && !closing);
  }
};

void check_precision(const World& world, const std::vector<PairBound>& watches) {
  const double threshold = world.contact_threshold();
  for (const PairBound& watch : watches)
    for (const auto id : {watch.a, watch.b}) {
      const double far = world.pose(id).position.cwiseAbs().maxCoeff();
      if (far * std::numeric_limits<double>::epsilon() > precise * threshold)
        fail(
            "moving near '{}': {} m from the origin, a contact threshold of {} m is lost in "
            "rounding",
            excerpt(world.body(id).name), far, threshold);
    }
}

}  // namespace

Advance advance(World& world, std::vector<PairBound>& watches, double end,
                const std::function<void(double)>& place, int& queries, int max_steps) {
  const Advancing run{world, end};
  const auto later = [&](PairBound& watch, double s) {
    watch.safe = s + (watch.gap - run.keep(watch)) / watch.speed;
  };
  for (PairBound& watch : watches) {
    watch.gap = 0;
    watch.touching = false;
    watch.near = {-1, -1};
    watch.safe =
        watch.clear > 2 * run.threshold ? (watch.clear - aim * run.threshold) / watch.speed : 0;
  }

  double s = -1;
  const auto go = [&](double to) {
    if (to != s) place(s = to);
  };
  // what is known of each pair where the motion stands
  const auto arrive = [&](std::optional<PairBound> stopped_by, bool iteration_limit = false) {
    for (PairBound& watch : watches) watch.clear = std::max(0.0, (watch.safe - s) * watch.speed);
    return Advance{s, std::move(stopped_by), iteration_limit};
  };
  check_precision(world, watches);
  for (int step = 0; true; ++step) {
    // the pair that is known to be apart for the shortest while
    const auto next =
        std::min_element(watches.begin(), watches.end(),
                         [](const PairBound& x, const PairBound& y) { return x.safe < y.safe; });
    if (next == watches.end() || next->safe >= end) {
      go(end);
      return arrive(std::nullopt);
    }
    world.context().progress().check();
    check_stop();
    go(next->safe);
    const bool stop = run.stops(*next, s, queries);
    if (stop || step == max_steps) return arrive(*next, !stop);
    later(*next, s);
    next->safe = std::max(next->safe, std::nextafter(s, 2 * end));
  }
}

}  // namespace clench
