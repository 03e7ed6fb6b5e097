// Disjoint sets of indices, by union and find.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

namespace clench {

/// Sets of the indices from 0, initially one per set. The smallest index represents its set.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count = 0) { reset(count); }
  /// Separates all indices; keeps its memory.
  void reset(size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    i = find(i), j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace clench
