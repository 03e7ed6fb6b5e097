// Cache of a grasp's wrench spaces.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clench/grasp/wrench/wrench_space.h"

namespace clench {

/// Space of the unit wrenches about the center of mass. Edges and torque length are those of the
/// grasp unless the options set others.
struct GraspSpaceOptions {
  WrenchSpaceOptions space = {};
  std::optional<int> edges = {};
  std::optional<double> rho = {};  ///< [m]

  bool operator==(const GraspSpaceOptions&) const = default;
};

using WrenchSpacePtr = std::shared_ptr<const WrenchSpace>;

/// The most recent ones, since spaces cache their results. A copy begins empty: a space is for one
/// thread.
class KeptSpaces {
 public:
  KeptSpaces() = default;
  KeptSpaces(const KeptSpaces&) {}
  KeptSpaces(KeptSpaces&&) = default;
  KeptSpaces& operator=(const KeptSpaces&) { return spaces_.clear(), *this; }
  KeptSpaces& operator=(KeptSpaces&&) = default;

  /// The space with these options; `make` creates it if it is not cached.
  template <class Make>
  const WrenchSpacePtr& get(const GraspSpaceOptions& options, Make make) {
    // the most recently used one is last
    for (auto known = spaces_.begin(); known != spaces_.end(); ++known)
      if (known->first == options) {
        std::rotate(known, known + 1, spaces_.end());
        return spaces_.back().second;
      }
    if (spaces_.size() == max_kept) spaces_.erase(spaces_.begin());
    return spaces_.emplace_back(options, std::make_shared<const WrenchSpace>(make())).second;
  }

 private:
  static constexpr size_t max_kept = 16;  // more than any measure uses together
  std::vector<std::pair<GraspSpaceOptions, WrenchSpacePtr>> spaces_;
};

}  // namespace clench
