#include "grasp/contact_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "grasp/symmetry_cone.h"

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

ContactReach::ContactReach(int dimension, WrenchNorm norm, std::span<const ContactPart> parts)
    : dimension_(dimension), norm_(norm) {
  // in L1 the points of all contacts are one block
  size_t total = 0;
  for (const ContactPart& part : parts) total += part.count + lanes;
  coordinates_.reserve(total * dimension);
  const auto add_block = [&](std::span<const ContactPart> of) {
    int count = 0;
    for (const ContactPart& part : of) count += part.axis ? 0 : part.count;
    const int padded = (count + lanes - 1) / lanes * lanes;
    const Block block{static_cast<int>(coordinates_.size()), count, padded};
    if (count == 0) return Block{0, 0, 0};
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
    if (const Block all = add_block(parts); all.padded > 0) blocks_.push_back(all);
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

double ContactReach::farthest(const Block& block, const double* direction, int& column) const {
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

double ContactReach::farthest(const Round& round, const double* direction, double* along) const {
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

void ContactReach::add_point(const Block& block, int column, double* point) const {
  const double* x = coordinates_.data() + block.begin + column;
  for (int row = 0; row < dimension_; ++row) point[row] += x[row * block.padded];
}

void ContactReach::add_point(const Round& round, const double* along, double* point) const {
  for (int row = 0; row < dimension_; ++row) {
    double x = round.axis[row];
    for (int k = 0; k < round.width; ++k) x += along[k] * round.spread[k][row];
    point[row] += x;
  }
}

double ContactReach::support(const double* direction, double* point) const {
  std::fill_n(point, dimension_, 0.0);
  if (norm_ == WrenchNorm::linf) {
    double sum = 0;
    for (const Block& block : blocks_) {
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

DirectionCone ContactReach::least_support_cone() const {
  if (norm_ == WrenchNorm::linf || !rounds_.empty()) return cone_of_parts();
  if (blocks_.empty()) return {};
  const Block& all = blocks_[0];
  return symmetry_cone({dimension_, all.count, all.padded, coordinates_.data() + all.begin, {}});
}

// Isometries that carry contacts to contacts. Those that carry eight points around an ellipse, and two more of an
// ellipsoid, to such points carry the round sets, too. Pyramids are none of them: a mixture is left as it is.
DirectionCone ContactReach::cone_of_parts() const {
  static constexpr double s = std::numbers::sqrt2 / 2;
  static constexpr double around[][3] = {{1, 0, 0},  {s, s, 0},   {0, 1, 0},  {-s, s, 0},
                                         {-1, 0, 0}, {-s, -s, 0}, {0, -1, 0}, {s, -s, 0},
                                         {0, 0, 1},  {0, 0, -1}};
  if (!rounds_.empty() && !contact_blocks_.empty()) return {};
  std::vector<double> points;  // one after the other
  std::vector<int> parts;
  for (size_t c = 0; c < contacts_.size(); ++c) {
    const auto add = [&](const auto& add_to) {
      points.resize(points.size() + dimension_);
      add_to(points.data() + points.size() - dimension_);
      parts.push_back(static_cast<int>(c));
    };
    if (contacts_[c].block >= 0) {
      const Block& block = contact_blocks_[contacts_[c].block];
      for (int i = 0; i < block.count; ++i) add([&](double* to) { add_point(block, i, to); });
    } else if (contacts_[c].round >= 0) {
      const Round& round = rounds_[contacts_[c].round];
      // in fewer dimensions an ellipsoid may lie in a line, and ten points tell it no longer
      if (round.width == 3 && dimension_ < most_dimensions) return {};
      for (const double* along : around) {
        const int last = along[2] != 0 ? 2 : along[1] != 0 ? 1 : 0;
        if (last < std::max(round.width, 1)) add([&](double* to) { add_point(round, along, to); });
      }
    }
  }
  const int count = static_cast<int>(parts.size());
  std::vector<double> rows(points.size());
  for (int i = 0; i < count; ++i)
    for (int row = 0; row < dimension_; ++row) rows[row * count + i] = points[i * dimension_ + row];
  return symmetry_cone({dimension_, count, count, rows.data(), parts});
}

double ContactReach::support_of(int contact, const double* direction) const {
  const Place& place = contacts_[contact];
  int column;
  double along[3];
  if (place.round >= 0) return farthest(rounds_[place.round], direction, along);
  if (place.block >= 0) return farthest(contact_blocks_[place.block], direction, column);
  return nowhere;
}

}  // namespace clench
