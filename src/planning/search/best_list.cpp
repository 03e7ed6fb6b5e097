#include "clench/planning/search/best_list.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"

namespace clench {

BestList::BestList(const BestListOptions& options) : options_(options) {
  if (options.size < 1 || options.size > 1'000'000)
    fail("best list: size: expected 1 to 1000000, got {}", options.size);
  if (!(options.distance >= 0)) fail("best list: distance must be >= 0, got {}", options.distance);
  if (!(options.radius > 0)) fail("best list: radius must be > 0 [m], got {}", options.radius);
}

bool BestList::may_keep(double energy) const {
  if (!(energy <= options_.max_energy)) return false;
  return static_cast<int>(states_.size()) < options_.size || energy < states_.back().energy;
}

bool BestList::add(const SearchSpace& space, FoundState found) {
  if (!may_keep(found.energy)) return false;
  const auto alike = [&](const FoundState& other) {
    return space.alike(found.state, other.state, options_.radius, options_.posture,
                       options_.distance);
  };
  const auto worse = std::ranges::upper_bound(states_, found.energy, {}, &FoundState::energy);
  if (std::any_of(states_.begin(), worse, alike)) return false;
  states_.erase(std::remove_if(worse, states_.end(), alike), states_.end());
  states_.insert(std::ranges::upper_bound(states_, found.energy, {}, &FoundState::energy),
                 std::move(found));
  if (static_cast<int>(states_.size()) > options_.size) states_.pop_back();
  return true;
}

bool BestList::is_avoided(const SearchSpace& space, const HandState& state) const {
  return std::ranges::any_of(avoided_, [&](const HandState& other) {
    return space.alike(state, other, options_.radius, options_.posture, options_.distance);
  });
}

}  // namespace clench
