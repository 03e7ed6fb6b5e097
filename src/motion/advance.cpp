#include "motion/advance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clench {

// a stop aims at a quarter of the threshold: all of a patch is then within it, and rounding far below
static constexpr double aim = 0.25;
// a motion that needs more than this grazes for metres within micrometres: it ends where it is
static constexpr int most_queries = 1000000;

Advance advance(const World& world, std::vector<Watch>& watches, double end,
                const std::function<void(double)>& place, int& queries) {
  const double threshold = world.contact_threshold();
  for (Watch& watch : watches) watch.safe = 0;
  double s = -1;
  const int last_query = queries + most_queries;
  const auto go = [&](double to) {
    if (to != s) place(s = to);
  };
  while (true) {
    // the pair that is known to be apart for the shortest while
    const auto next =
        std::min_element(watches.begin(), watches.end(),
                         [](const Watch& x, const Watch& y) { return x.safe < y.safe; });
    if (next == watches.end() || next->safe >= end) {
      go(end);
      return {end, std::nullopt};
    }
    Watch& watch = *next;
    go(watch.safe);
    // beyond what the rest of the motion can cover, the distance is of no interest
    const double reach = watch.speed * (end - s) + 2 * threshold;
    const std::array a{watch.a}, b{watch.b};
    const double gap = std::min(distance(world, a, b, reach).distance, reach);
    const bool closing = s > 0 && gap < watch.gap;
    ++queries;
    watch.gap = gap;
    if (s == 0) watch.touching = gap <= threshold;
    if (watch.touching && gap > 2 * threshold) watch.touching = false;
    if (!watch.touching && gap <= threshold) return {s, watch};
    if (watch.touching && closing && gap <= nearly_closed * threshold) return {s, watch};
    if (queries >= last_query) return {s, watch};
    const double keep = watch.touching ? std::min(aim * threshold, gap / 2) : aim * threshold;
    watch.safe = std::max(s + (gap - keep) / watch.speed, std::nextafter(s, 2 * end));
  }
}

}  // namespace clench
