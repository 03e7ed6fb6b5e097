// The best states of a search, no two alike.
#pragma once
#include "clench/planning/space/search_space.h"

namespace clench {

/// A state that a search met.
struct FoundState {
  Values values;
  HandState state;
  double energy = 0;
  int64_t step = 0;
};

struct BestListOptions {
  int size = 20;          ///< at most so many, >= 1
  double distance = 0.2;  ///< two states that are nearer are alike, see SearchSpace::distance
  bool posture = true;    ///< do postures count in it?
  double radius = 1;      ///< of the object, > 0 [m]
  double max_energy = std::numeric_limits<double>::infinity();  ///< worse ones are not kept
};

class BestList {
 public:
  /// throws  Error when an option is out of range
  explicit BestList(const BestListOptions& options);

  const std::vector<FoundState>& states() const { return states_; }  ///< best first
  const std::vector<HandState>& avoided() const { return avoided_; }
  const BestListOptions& options() const { return options_; }
  /// Would a state of this energy be kept if none were like it?
  bool may_keep(double energy) const;
  /// returns  was it kept: none that is as good is like it, and the list has room or worse ones
  bool add(const SearchSpace& space, FoundState found);
  /// Searches go around it from now on.
  void avoid(const HandState& state) { avoided_.push_back(state); }
  bool is_avoided(const SearchSpace& space, const HandState& state) const;
  void clear() { states_.clear(); }

 private:
  BestListOptions options_;
  std::vector<FoundState> states_;
  std::vector<HandState> avoided_;
};

}  // namespace clench
