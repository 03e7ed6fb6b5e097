#include "grasp/point_classes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/convert.h"
#include "grasp/support_set.h"

namespace clench {

namespace {

// Rounding of marks is some 1e-15.
constexpr double alike_marks = 1e-14;

// Products and sums of products, in float, of points whose longest has length one. They only choose what
// to try.
constexpr float nearly_alike = 1e-5f;

// So many points may as well be tried.
constexpr int few = 8;

// Products of all with all of so many take 3 ms and 4 MB; of more, often longer than the whole search.
constexpr int most_points = 1024;

// By cells of a grid in a table of hashes. Numbers of one cell, a hundred times as wide as what is alike, count
// as alike: of a thousand that are not one in a million times.
bool all_differ(std::span<const double> marks) {
  constexpr double per_cell = 0x1p40;
  size_t size = 64;
  while (size < 4 * marks.size()) size *= 2;
  constexpr int64_t none = std::numeric_limits<int64_t>::min();
  std::vector<int64_t> cells(size, none);
  const auto place = [&](int64_t cell) {
    size_t at = (static_cast<uint64_t>(cell) * 0x9e3779b97f4a7c15u >> 20) & (size - 1);
    while (cells[at] != none && cells[at] != cell) at = (at + 1) & (size - 1);
    return at;
  };
  for (const double mark : marks) {
    const double low = (mark - alike_marks) * per_cell, high = (mark + alike_marks) * per_cell;
    const int64_t first = floor_between(low, none + 1, -(none + 1));
    const int64_t last = floor_between(high, none + 1, -(none + 1));
    const size_t at = place(first);
    if (cells[at] != none || (last != first && cells[place(last)] != none)) return false;
    cells[at] = first;
  }
  return true;
}

std::vector<double> squared_lengths(const TellingPoints& points) {
  std::vector<double> out(points.count);
  for (int k = 0; k < points.dimension; ++k) {
    const double* x = points.coordinates + k * points.stride;
    for (int i = 0; i < points.count; ++i) out[i] += x[i] * x[i];
  }
  return out;
}

// in eight sums side by side
double mean_product(const double* x, const double* y, int count) {
  double sums[8] = {}, sum = 0;
  int i = 0;
  for (; i + 8 <= count; i += 8)
    for (int lane = 0; lane < 8; ++lane) sums[lane] += x[i + lane] * y[i + lane];
  for (; i < count; ++i) sums[i % 8] += x[i] * y[i];
  for (const double part : sums) sum += part;
  return sum / count;
}

// Isometries leave the mean m and the second moments C of all points alone, and so m . p and p . C p.
void add_moments(const TellingPoints& points, std::vector<double>& out) {
  const std::vector<double> ones(points.count, 1);
  for (int k = 0; k < points.dimension; ++k) {
    const double* x = points.coordinates + k * points.stride;
    const double mean = 0.37 * mean_product(x, ones.data(), points.count);
    for (int i = 0; i < points.count; ++i) out[i] += mean * x[i];
    for (int j = 0; j <= k; ++j) {
      const double* y = points.coordinates + j * points.stride;
      const double both = (j < k ? 2 : 1) * 0.71 * mean_product(x, y, points.count);
      for (int i = 0; i < points.count; ++i) out[i] += both * x[i] * y[i];
    }
  }
}

}  // namespace

std::vector<double> point_marks(const TellingPoints& points) {
  if (points.count > most_points) return {};
  std::vector<double> marks = squared_lengths(points);
  // as of most sets
  if (all_differ(marks)) return {};
  add_moments(points, marks);
  if (all_differ(marks)) return {};
  return marks;
}

PointClasses::PointClasses(const TellingPoints& points, std::span<const double> marks)
    : count_(points.count), row_((count_ + lanes - 1) / lanes * lanes) {
  const std::vector<double> squares = squared_lengths(points);
  const double most = *std::max_element(squares.begin(), squares.end());
  const double scale = most > 0 ? 1 / std::sqrt(most) : 1;
  // zeros beyond the last point and the dimension
  x_.resize(static_cast<size_t>(row_) * most_dimensions);
  scratch_.resize(row_);
  for (int k = 0; k < points.dimension; ++k)
    for (int i = 0; i < count_; ++i)
      x_[k * row_ + i] = static_cast<float>(points.coordinates[k * points.stride + i] * scale);

  // as exact as can be first: of most sets that are nearly symmetric nothing is left
  std::vector<std::pair<double, int>> order(count_);
  for (int i = 0; i < count_; ++i) order[i] = {marks[i], i};
  std::sort(order.begin(), order.end());
  std::vector<std::pair<float, int>> alike_ones;
  for (int first = 0, last = 0; first < count_; first = last) {
    do ++last;
    while (last < count_ && order[last].first - order[last - 1].first <= alike_marks);
    alike_ones.clear();
    for (int at = first; at < last; ++at)
      alike_ones.emplace_back(last - first > few ? sum_of_products(order[at].second) : 0,
                              order[at].second);
    std::sort(alike_ones.begin(), alike_ones.end());
    for (size_t at = 0; at < alike_ones.size(); ++at) {
      if (at == 0 || alike_ones[at].first - alike_ones[at - 1].first > nearly_alike)
        classes_.push_back({first + static_cast<int>(at), 0});
      classes_.back().end = first + static_cast<int>(at) + 1;
      given_.push_back(alike_ones[at].second);
      class_of_.push_back(static_cast<int>(classes_.size()) - 1);
    }
  }
  const std::vector<float> x = x_;
  for (int i = 0; i < count_; ++i)
    for (int k = 0; k < most_dimensions; ++k) x_[k * row_ + i] = x[k * row_ + given_[i]];
  products_ = std::make_unique_for_overwrite<float[]>(static_cast<size_t>(count_) * row_);
  have_.resize(count_);
  fits_.resize(row_);
}

float PointClasses::sum_of_products(int point) {
  multiply(point, scratch_.data());
  float sums[lanes] = {}, sum = 0;
  for (int start = 0; start < row_; start += lanes)
    for (int lane = 0; lane < lanes; ++lane) {
      const float t = scratch_[start + lane];
      sums[lane] += t * (0.37f + t * (0.71f + t * (0.53f + t * 0.29f)));
    }
  for (const float part : sums) sum += part;
  return sum / static_cast<float>(count_);
}

void PointClasses::multiply(int point, float* out) const {
  float own[most_dimensions];
  for (int k = 0; k < most_dimensions; ++k) own[k] = x_[k * row_ + point];
  for (int start = 0; start < row_; start += lanes)
    for (int lane = 0; lane < lanes; ++lane) {
      const int i = start + lane;
      float sum = own[0] * x_[i];
      for (int k = 1; k < most_dimensions; ++k) sum += own[k] * x_[k * row_ + i];
      out[i] = sum;
    }
}

const float* PointClasses::products(int point) {
  float* out = &products_[static_cast<size_t>(point) * row_];
  if (!have_[point]) multiply(point, out);
  have_[point] = true;
  return out;
}

std::vector<PointClasses::Range> PointClasses::rarest_first() const {
  std::vector<Range> out = classes_;
  std::stable_sort(out.begin(), out.end(),
                   [](const Range& a, const Range& b) { return a.size() < b.size(); });
  return out;
}

// without branches that depend on what fits
void PointClasses::fitting(Range all, int point, std::span<const int> others,
                           std::span<const int> with, std::vector<int>& out) {
  const int size = all.size();
  std::fill_n(fits_.begin(), size, 1);
  for (size_t k = 0; k < with.size(); ++k) {
    const float wanted = products(others[k])[point];
    const float* is = products(with[k]) + all.begin;
    int* fits = fits_.data();
    for (int i = 0; i < size; ++i) fits[i] &= std::abs(is[i] - wanted) <= nearly_alike;
  }
  out.resize(size);
  int count = 0;
  for (int i = 0; i < size; ++i) {
    out[count] = all.begin + i;
    count += fits_[i];
  }
  out.resize(count);
}

}  // namespace clench
