// Offsets of facets by number, of which the least is asked for again and again while many change
// each time: blocks that know their own least, in no order. Includes no Eigen.
#pragma once
#include <limits>
#include <vector>

namespace clench {

class OffsetList {
 public:
  void clear() { offsets_.clear(), blocks_.clear(); }

  void set(int index, double offset) {
    while (static_cast<int>(offsets_.size()) <= index) {
      offsets_.resize(offsets_.size() + block, none);
      blocks_.push_back({none, false});
    }
    OffsetBlock& of = blocks_[index / block];
    of.stale |= offsets_[index] == of.least && offset > of.least;
    offsets_[index] = offset;
    of.least = offset < of.least ? offset : of.least;
  }

  void drop(int index) {
    if (static_cast<int>(offsets_.size()) <= index) return;
    OffsetBlock& of = blocks_[index / block];
    of.stale |= offsets_[index] == of.least;
    offsets_[index] = none;
  }

  /// returns  the index of the least, the lowest of several; -1: there is none
  int least() {
    double least = none;
    int in = -1;
    for (int b = 0; b < static_cast<int>(blocks_.size()); ++b) {
      if (blocks_[b].stale) refresh(b);
      if (blocks_[b].least < least) least = blocks_[b].least, in = b;
    }
    if (in < 0) return -1;
    int index = in * block;
    while (offsets_[index] != least) ++index;
    return index;
  }

 private:
  static constexpr int block = 64, lanes = 8;
  static constexpr double none = std::numeric_limits<double>::infinity();
  struct OffsetBlock {
    double least;
    bool stale;  // the least may be gone
  };

  void refresh(int b) {
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
  std::vector<OffsetBlock> blocks_;
};

}  // namespace clench
