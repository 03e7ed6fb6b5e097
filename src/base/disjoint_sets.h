// Which of many numbers belong together, by union and find.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

namespace clench {

/// Numbers from 0, each by itself at first. The least of a set stands for it.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count = 0) { reset(count); }
  /// All apart again; keeps its memory.
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
