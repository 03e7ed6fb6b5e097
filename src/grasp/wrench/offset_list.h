// Offsets of facets by index, with fast repeated queries of the minimum while many change between
// queries: blocks that cache their minimum, and groups of blocks that cache theirs. Includes no
// Eigen.
#pragma once
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace clench {

class OffsetList {
 public:
  void clear() { offsets_.clear(), blocks_.clear(), groups_.clear(); }

  void set(int index, double offset) {
    while (size() <= index) {
      if (size() % group == 0) groups_.push_back({});
      blocks_.push_back({});
      offsets_.resize(offsets_.size() + block, none);
    }
    const double before = std::exchange(offsets_[index], offset);
    blocks_[index / block].change(before, offset);
    groups_[index / group].change(before, offset);
  }

  void drop(int index) {
    if (index < size()) set(index, none);
  }

  /// returns  index of the minimum, the lowest of several; -1: the list is empty
  int least() {
    double least = none;
    int in = -1;
    for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
      if (groups_[g].stale) refresh_group(g);
      if (groups_[g].least < least) least = groups_[g].least, in = g;
    }
    if (in < 0) return -1;
    // a stale block has a larger value: were it equal, its group would be stale, and refreshed
    // above
    int b = in * (group / block);
    while (blocks_[b].least != least) ++b;
    int index = b * block;
    while (offsets_[index] != least) ++index;
    return index;
  }

 private:
  static constexpr int block = 64, group = 64 * block, lanes = 8;
  static constexpr double none = std::numeric_limits<double>::infinity();
  struct Least {
    double least = none;
    bool stale = false;  // the minimum may have been removed

    void change(double before, double now) {
      stale |= before == least && now > least;
      least = now < least ? now : least;
    }
  };

  int size() const { return static_cast<int>(offsets_.size()); }

  void refresh_group(int g) {
    double least = none;
    const int first = g * (group / block);
    const int end = std::min(first + group / block, static_cast<int>(blocks_.size()));
    for (int b = first; b < end; ++b) {
      if (blocks_[b].stale) refresh_block(b);
      least = blocks_[b].least < least ? blocks_[b].least : least;
    }
    groups_[g] = {least, false};
  }

  void refresh_block(int b) {
    const double* x = &offsets_[static_cast<size_t>(b) * block];
    double least[lanes];
    for (int lane = 0; lane < lanes; ++lane) least[lane] = x[lane];
    for (int i = lanes; i < block; i += lanes)
      for (int lane = 0; lane < lanes; ++lane)
        least[lane] = x[i + lane] < least[lane] ? x[i + lane] : least[lane];
    for (int lane = 1; lane < lanes; ++lane)
      least[0] = least[lane] < least[0] ? least[lane] : least[0];
    blocks_[b] = {least[0], false};
  }

  std::vector<double> offsets_;
  std::vector<Least> blocks_, groups_;
};

}  // namespace clench
