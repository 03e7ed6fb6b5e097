#include "clench/math/block_lu.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {

void BlockLu::analyze(const std::vector<int>& sizes,
                      const std::vector<std::pair<int, int>>& pairs) {
  sizes_ = sizes;
  first_.assign(1, 0);
  for (const int size : sizes) first_.push_back(first_.back() + size);
  all_six_ = std::ranges::all_of(sizes, [](int size) { return size == 6; });
  find_order(pairs);
  lay_out();
}

// Minimum degree ordering: eliminates the group with the fewest neighbors, the first of several,
// until no group is left; its neighbors become neighbors of each other.
void BlockLu::find_order(const std::vector<std::pair<int, int>>& pairs) {
  const size_t count = sizes_.size();
  neighbors_.assign(count, {});
  for (const auto& [i, j] : pairs) neighbors_[i].push_back(j), neighbors_[j].push_back(i);
  for (auto& list : neighbors_) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  order_.clear();
  position_.assign(count, -1);
  std::vector<int> merged;
  StopCheck check(16);
  while (order_.size() < count) {
    check();
    int next = -1;
    for (int i = 0; i < static_cast<int>(count); ++i)
      if (position_[i] < 0 && (next < 0 || neighbors_[i].size() < neighbors_[next].size()))
        next = i;
    position_[next] = static_cast<int>(order_.size());
    order_.push_back(next);
    for (const int i : neighbors_[next]) {
      merged.clear();
      std::ranges::set_union(neighbors_[i], neighbors_[next], std::back_inserter(merged));
      std::erase_if(merged, [&](int k) { return k == i || k == next; });
      neighbors_[i].swap(merged);
    }
  }
}

void BlockLu::lay_out() {
  const size_t count = sizes_.size();
  int size = 0;
  diagonal_.resize(count), later_.resize(count);
  for (const int k : order_) {
    diagonal_[k] = size;
    size += sizes_[k] * sizes_[k];
    later_[k].clear();
    for (const int i : neighbors_[k]) {
      later_[k].push_back({.group = i, .upper = size, .lower = size + sizes_[k] * sizes_[i]});
      size += 2 * sizes_[k] * sizes_[i];
    }
  }
  values_.assign(size, 0);
  targets_.clear(), first_target_.assign(count, 0);
  for (const int k : order_) {
    first_target_[k] = static_cast<int>(targets_.size());
    for (const Later& i : later_[k])
      for (const Later& j : later_[k]) targets_.push_back(place(i.group, j.group));
  }
}

void BlockLu::set_zero() { std::ranges::fill(values_, 0); }

int BlockLu::place(int i, int j) const {
  if (i == j) return diagonal_[i];
  const bool upper = position_[i] < position_[j];
  const auto& later = later_[upper ? i : j];
  const auto found = std::ranges::lower_bound(later, upper ? j : i, {}, &Later::group);
  return upper ? found->upper : found->lower;
}

namespace {

// Replaces a, n x n by columns, by its inverse: Gauss-Jordan elimination with row exchanges.
// Size  n if it is known, so that all loops are of known length; else Eigen::Dynamic
template <int Size>
bool invert(int rows, double* a, int* exchanged) {
  const int n = Size == Eigen::Dynamic ? rows : Size;
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a[n * k + i]) > std::abs(a[n * k + best])) best = i;
    exchanged[k] = best;
    if (best != k)
      for (int j = 0; j < n; ++j) std::swap(a[n * j + k], a[n * j + best]);
    const double pivot = a[n * k + k];
    if (pivot == 0 || !std::isfinite(pivot)) return false;
    const double inverse = 1 / pivot;
    double* own = a + n * k;
    for (int i = 0; i < n; ++i) own[i] *= -inverse;
    own[k] = inverse;
    for (int j = 0; j < n; ++j) {
      if (j == k) continue;
      double* other = a + n * j;
      const double x = other[k];
      other[k] = 0;
      for (int i = 0; i < n; ++i) other[i] += own[i] * x;
    }
  }
  // exchanged rows of a matrix are exchanged columns of its inverse
  for (int k = n - 1; k >= 0; --k)
    if (exchanged[k] != k)
      for (int i = 0; i < n; ++i) std::swap(a[n * k + i], a[n * exchanged[k] + i]);
  return true;
}

}  // namespace

// Size  of all groups; Eigen::Dynamic: groups may differ in size
template <int Size>
bool BlockLu::eliminate(int group) {
  exchanged_.resize(sizes_[group]);
  if (!invert<Size>(sizes_[group], &values_[diagonal_[group]], exchanged_.data())) return false;
  using Matrix = Eigen::Matrix<double, Size, Size>;
  using Block = Eigen::Map<Matrix>;
  const int n = sizes_[group];
  const Block inverse(&values_[diagonal_[group]], n, n);
  const auto& later = later_[group];
  for (const Later& j : later) {
    Block right(&values_[j.upper], n, sizes_[j.group]);
    const Matrix solved = inverse.lazyProduct(right);
    right = solved;
  }
  const int* target = targets_.data() + first_target_[group];
  for (const Later& i : later) {
    const Block left(&values_[i.lower], sizes_[i.group], n);
    for (const Later& j : later) {
      const Block right(&values_[j.upper], n, sizes_[j.group]);
      Block(&values_[*target++], sizes_[i.group], sizes_[j.group]).noalias() -=
          left.lazyProduct(right);
    }
  }
  return true;
}

bool BlockLu::factor() {
  StopCheck check(4);
  for (const int k : order_) {
    check();
    if (!(all_six_ ? eliminate<6>(k) : eliminate<Eigen::Dynamic>(k))) return false;
  }
  return true;
}

namespace {

// y -= a x, by columns
void subtract_product(int rows, int columns, const double* a, const double* x, double* y) {
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) y[i] -= a[rows * j + i] * x[j];
}

}  // namespace

void BlockLu::solve(Eigen::VectorXd& x) const {
  std::vector<double> solved;
  for (const int k : order_) {
    const int n = sizes_[k];
    double* own = &x[first_[k]];
    solved.assign(n, 0.0);
    subtract_product(n, n, &values_[diagonal_[k]], own, solved.data());
    for (int i = 0; i < n; ++i) own[i] = -solved[i];
    for (const Later& i : later_[k])
      subtract_product(sizes_[i.group], n, &values_[i.lower], own, &x[first_[i.group]]);
  }
  for (size_t p = order_.size(); p-- > 0;) {
    const int k = order_[p];
    for (const Later& j : later_[k])
      subtract_product(sizes_[k], sizes_[j.group], &values_[j.upper], &x[first_[j.group]],
                       &x[first_[k]]);
  }
}

}  // namespace clench
