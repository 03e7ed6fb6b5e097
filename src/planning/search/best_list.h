// The best states of a search, excluding similar ones.
#pragma once
#include "clench/planning/space/search_space.h"

namespace clench {

/// A state visited by a search.
struct FoundState {
  Values values;
  HandState state;
  double energy = 0;
  int64_t step = 0;
};

struct BestListOptions {
  int size = 20;          ///< maximum number, >= 1
  double distance = 0.2;  ///< states that are nearer are similar, see SearchSpace::distance
  bool posture = true;    ///< does the distance include postures?
  double radius = 1;      ///< of the object, > 0 [m]
  double max_energy = std::numeric_limits<double>::infinity();  ///< worse ones are not kept
};

class BestList {
 public:
  /// throws  Error if an option is out of range
  explicit BestList(const BestListOptions& options);

  const std::vector<FoundState>& states() const { return states_; }  ///< best first
  const std::vector<HandState>& avoided() const { return avoided_; }
  const BestListOptions& options() const { return options_; }
  /// Would a state of this energy be kept if none were similar?
  bool may_keep(double energy) const;
  /// returns  true if it is kept: no similar state is as good, and the list is not full or has
  ///          worse ones
  bool add(const SearchSpace& space, FoundState found);
  /// Excludes its surroundings from now on.
  void avoid(const HandState& state) { avoided_.push_back(state); }
  bool is_avoided(const SearchSpace& space, const HandState& state) const;
  void clear() { states_.clear(); }

 private:
  BestListOptions options_;
  std::vector<FoundState> states_;
  std::vector<HandState> avoided_;
};

}  // namespace clench
