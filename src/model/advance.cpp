#include "clench/model/advance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

// a stop is well within the threshold, so that the complete patch is within it, and far above
// rounding: steps aim at the first fraction of the threshold, and gaps below the second count as a
// touch
static constexpr double aim = 0.2;
static constexpr double there = 0.3;
// a bound is at least this fraction of the distance, and used beyond this many thresholds
static constexpr double bound_part = 0.85, bound_beyond = 4;
// minimum gap assumed for a pair, as a fraction of the threshold; 0 means unknown
static constexpr double touching_gap = 1e-9;
// rounding of positions must be smaller than the threshold by this factor
static constexpr double precise = 1e-3;

namespace {

struct Advancing {
  World& world;
  double end;
  double threshold = world.contact_threshold();

  // the gap that a step must leave: a touching pair may use up half of its gap
  double keep(const PairBound& watch) const {
    return watch.touching ? std::min(aim * threshold, watch.gap / 2) : aim * threshold;
  }

  // the distance of the pair at s, or a lower bound that shows that it is well apart [m]
  double measure(PairBound& watch, double s, int& queries) const {
    const Body &a = world.body(watch.a), &b = world.body(watch.b);
    const double spheres = sphere_gap(world, watch.a, watch.b);
    if (spheres > 0.1 * (a.shape->radius() + b.shape->radius())) return spheres;
    // distances beyond what the rest of the motion can cover are irrelevant
    const double reach = watch.speed * (end - s) + 2 * threshold;
    // far from a touch a lower bound is sufficient; a pair that was near is measured exactly
    if (watch.gap == 0 || watch.gap > bound_beyond * threshold) {
      ++queries;
      const double bound =
          distance_bound(*a.shape, *b.shape, relative_pose(world, watch.a, watch.b), reach,
                         bound_part, watch.near);
      if (bound >= reach || bound > bound_beyond * threshold) return bound;
    }
    ++queries;
    const std::array one{watch.a}, other{watch.b};
    // faces that coincide up to rounding separate as from a gap
    const double gap = distance(world, one, other, reach, &world.context()).distance;
    return std::clamp(gap, touching_gap * threshold, reach);
  }

  // measures the pair at s.
  // returns  true if it stops the motion there
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
  // data of each pair at the present s
  const auto arrive = [&](std::optional<PairBound> stopped_by, bool iteration_limit = false) {
    for (PairBound& watch : watches) watch.clear = std::max(0.0, (watch.safe - s) * watch.speed);
    return Advance{s, std::move(stopped_by), iteration_limit};
  };
  check_precision(world, watches);
  for (int step = 0; true; ++step) {
    // the pair whose guarantee of separation ends first
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
