#include "clench/grasp/wrench/wrench_support.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clench {

namespace {

constexpr int lanes = 4, chunk = 64;
constexpr double nowhere = -std::numeric_limits<double>::infinity();

// the largest product of the direction with a column, and the first column that has it
template <int D>
double farthest_column(const double* x, int padded, const double* direction, int& column) {
  double best = nowhere;
  column = 0;
  for (int start = 0; start < padded; start += chunk) {
    const int count = std::min(chunk, padded - start);
    double value[chunk];
    for (int i = 0; i < count; ++i) {
      double sum = direction[0] * x[start + i];
      for (int row = 1; row < D; ++row) sum += direction[row] * x[row * padded + start + i];
      value[i] = sum;
    }
    double top[lanes];
    for (int lane = 0; lane < lanes; ++lane) top[lane] = value[lane];
    for (int i = lanes; i < count; i += lanes)
      for (int lane = 0; lane < lanes; ++lane)
        top[lane] = value[i + lane] > top[lane] ? value[i + lane] : top[lane];
    const double here = std::max(std::max(top[0], top[1]), std::max(top[2], top[3]));
    if (here <= best) continue;
    best = here;
    column = start + static_cast<int>(std::find(value, value + count, here) - value);
  }
  return best;
}

}  // namespace

WrenchSupport::WrenchSupport(int dimension, WrenchNorm norm, std::span<const ContactPart> parts)
    : dimension_(dimension), norm_(norm) {
  // in L1 the points of all contacts are one block
  size_t total = 0;
  for (const ContactPart& part : parts) total += part.count + lanes;
  coordinates_.reserve(total * dimension);
  const auto add_block = [&](std::span<const ContactPart> of) {
    int count = 0;
    for (const ContactPart& part : of) count += part.axis ? 0 : part.count;
    const int padded = (count + lanes - 1) / lanes * lanes;
    const PointBlock block{static_cast<int>(coordinates_.size()), count, padded};
    if (count == 0) return PointBlock{0, 0, 0};
    coordinates_.resize(coordinates_.size() + static_cast<size_t>(padded) * dimension);
    double* x = coordinates_.data() + block.begin;
    int column = 0;
    for (const ContactPart& part : of)
      for (int i = 0; !part.axis && i < part.count; ++i, ++column)
        for (int row = 0; row < dimension; ++row)
          x[row * padded + column] = part.points[i * dimension + row];
    for (; column < padded; ++column)
      for (int row = 0; row < dimension; ++row) x[row * padded + column] = x[row * padded];
    return block;
  };
  if (norm == WrenchNorm::l1)
    if (const PointBlock all = add_block(parts); all.padded > 0) blocks_.push_back(all);
  for (size_t i = 0; i < parts.size(); ++i) {
    const ContactPart& part = parts[i];
    Place place{-1, -1};
    if (part.axis) {
      Round round{};
      round.width = part.width;
      std::copy_n(part.axis, dimension, round.axis);
      for (int k = 0; k < part.width; ++k)
        std::copy_n(part.spread + k * dimension, dimension, round.spread[k]);
      place.round = static_cast<int>(rounds_.size());
      rounds_.push_back(round);
    } else if (part.count > 0) {
      place.block = static_cast<int>(contact_blocks_.size());
      contact_blocks_.push_back(add_block(parts.subspan(i, 1)));
    }
    contacts_.push_back(place);
  }
  if (norm == WrenchNorm::linf) blocks_ = contact_blocks_;
}

double WrenchSupport::farthest(const PointBlock& block, const double* direction,
                               int& column) const {
  const double* x = coordinates_.data() + block.begin;
  switch (dimension_) {
    case 1:
      return farthest_column<1>(x, block.padded, direction, column);
    case 2:
      return farthest_column<2>(x, block.padded, direction, column);
    case 3:
      return farthest_column<3>(x, block.padded, direction, column);
    case 4:
      return farthest_column<4>(x, block.padded, direction, column);
    case 5:
      return farthest_column<5>(x, block.padded, direction, column);
    default:
      return farthest_column<6>(x, block.padded, direction, column);
  }
}

double WrenchSupport::farthest(const Round& round, const double* direction, double* along) const {
  double value = 0, square = 0;
  for (int row = 0; row < dimension_; ++row) value += direction[row] * round.axis[row];
  for (int k = 0; k < round.width; ++k) {
    along[k] = 0;
    for (int row = 0; row < dimension_; ++row) along[k] += direction[row] * round.spread[k][row];
    square += along[k] * along[k];
  }
  const double length = std::sqrt(square);
  if (length > 0)
    for (int k = 0; k < round.width; ++k) along[k] /= length;
  return value + length;
}

void WrenchSupport::add_point(const PointBlock& block, int column, double* point) const {
  const double* x = coordinates_.data() + block.begin + column;
  for (int row = 0; row < dimension_; ++row) point[row] += x[row * block.padded];
}

void WrenchSupport::add_point(const Round& round, const double* along, double* point) const {
  for (int row = 0; row < dimension_; ++row) {
    double x = round.axis[row];
    for (int k = 0; k < round.width; ++k) x += along[k] * round.spread[k][row];
    point[row] += x;
  }
}

double WrenchSupport::support(const double* direction, double* point) const {
  std::fill_n(point, dimension_, 0.0);
  if (norm_ == WrenchNorm::linf) {
    double sum = 0;
    for (const PointBlock& block : blocks_) {
      int column;
      const double value = farthest(block, direction, column);
      if (value > 0) add_point(block, column, point), sum += value;
    }
    for (const Round& round : rounds_) {
      double along[3];
      const double value = farthest(round, direction, along);
      if (value > 0) add_point(round, along, point), sum += value;
    }
    return sum;
  }
  double best = nowhere, along[3], best_along[3];
  int column = 0;
  const Round* best_round = nullptr;
  if (!blocks_.empty()) best = farthest(blocks_[0], direction, column);
  for (const Round& round : rounds_) {
    const double value = farthest(round, direction, along);
    if (value <= best) continue;
    best = value, best_round = &round;
    std::copy_n(along, 3, best_along);
  }
  if (best_round)
    add_point(*best_round, best_along, point);
  else if (!blocks_.empty())
    add_point(blocks_[0], column, point);
  else
    return 0;
  return best;
}

double WrenchSupport::support_of(int contact, const double* direction) const {
  const Place& place = contacts_[contact];
  int column;
  double along[3];
  if (place.round >= 0) return farthest(rounds_[place.round], direction, along);
  if (place.block >= 0) return farthest(contact_blocks_[place.block], direction, column);
  return nowhere;
}

}  // namespace clench
