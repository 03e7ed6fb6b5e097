#include "clench/grasp/wrench/sum_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "clench/base/hash.h"
#include "clench/base/random.h"
#include "clench/math/decompositions.h"

namespace clench {

namespace {

using CellMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using CellVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

// A point counts as rising above a rotating plane only if it rises by more than this times the sum
// of its coordinates on the cell: points in the axis of rotation move by rounding, and many points
// lie there if summands have directions in common.
constexpr double rounding_rise = 1e-13;
constexpr double repeated = 1e-9;  // columns nearer than this are merged
constexpr double flat = 1e-10;     // a sum this much thinner than wide has no volume
constexpr int max_lifts = 8;

// rounding broke the cells
struct BrokenCells {};

// Points of all summands, one after the other, and their lifted heights.
struct LiftedPoints {
  Eigen::MatrixXd x;
  std::vector<int> summand;
  Eigen::RowVectorXd height;
  int summands = 0;

  Eigen::Index dimension() const { return x.rows(); }
  int count() const { return static_cast<int>(summand.size()); }
};

// In coordinates in which the edges of all summands have the same extent in all directions.
LiftedPoints lift(std::span<const Eigen::MatrixXd> summands, const CellMatrix& coordinates,
                  Random& random) {
  LiftedPoints out;
  std::vector<CellVector> points;
  for (const Eigen::MatrixXd& columns : summands) {
    const auto first = static_cast<std::ptrdiff_t>(points.size());
    for (const auto& column : columns.colwise()) {
      const CellVector p = coordinates * column;
      const bool again = std::any_of(points.begin() + first, points.end(), [&](const auto& q) {
        return (p - q).cwiseAbs().maxCoeff() <= repeated;
      });
      if (!again) points.push_back(p), out.summand.push_back(out.summands);
    }
    ++out.summands;
  }
  out.x.resize(coordinates.rows(), static_cast<Eigen::Index>(points.size()));
  out.height.resize(out.x.cols());
  for (int i = 0; i < out.count(); ++i) {
    out.x.col(i) = points[i];
    out.height[i] = random.uniform();
  }
  return out;
}

// Ascending indices of points: of each summand the corners of a simplex; the edges of all simplices
// together span the space.
using Cell = std::vector<int>;

struct CellHash {
  size_t operator()(const Cell& cell) const {
    uint64_t state = 0;
    for (const int i : cell) state = Hasher::mix(state ^ static_cast<uint64_t>(i + 1));
    return state;
  }
};

void exchange(Cell& cell, int out, int in) {
  if (out >= 0) cell.erase(std::lower_bound(cell.begin(), cell.end(), out));
  cell.insert(std::lower_bound(cell.begin(), cell.end(), in), in);
}

// a corner of each summand's simplex, other than a given one
std::vector<int> first_corners(const LiftedPoints& points, const Cell& cell, int without = -1) {
  std::vector<int> out(points.summands, -1);
  for (const int i : cell)
    if (i != without && out[points.summand[i]] < 0) out[points.summand[i]] = i;
  return out;
}

struct NextPoint {
  int point = -1;  // -1: none
  double way = std::numeric_limits<double>::infinity();
};

// A rotating plane, and the points above it.
struct TurningPlane {
  Eigen::RowVectorXd level;  // of all points above the plane
  Eigen::RowVectorXd rise;   // their change as it rotates
  Eigen::RowVectorXd least;  // smallest rise that is not rounding
};

// The first point whose height over the plane reaches that of its summand's corner.
NextPoint next_point(const LiftedPoints& points, const Cell& cell, const std::vector<int>& corners,
                     const TurningPlane& plane) {
  const auto& [level, rise, least] = plane;
  NextPoint out;
  auto own = cell.begin();
  for (int i = 0; i < points.count(); ++i) {
    if (own != cell.end() && *own == i) {
      ++own;
      continue;
    }
    const int corner = corners[points.summand[i]];
    const double faster = rise[i] - rise[corner], room = level[corner] - level[i];
    if (faster > least[i] && room < faster * out.way) out = {i, std::max(0.0, room) / faster};
  }
  return out;
}

// The highest points, and then those that a plane above them reaches as it rotates until it lies on
// a cell.
Cell first_cell(const LiftedPoints& points, Random& random) {
  Cell cell(points.summands, -1);
  for (int i = 0; i < points.count(); ++i) {
    int& best = cell[points.summand[i]];
    if (best < 0 || points.height[i] > points.height[best]) best = i;
  }
  const Eigen::Index d = points.dimension();
  TurningPlane plane{points.height, {}, {}};
  plane.least.setConstant(points.count(), 1e4 * rounding_rise);
  CellMatrix spanned(d, 0);
  const auto across = [&](CellVector v) -> CellVector {
    for (int pass = 0; pass < 2; ++pass) v -= spanned * (spanned.transpose() * v).eval();
    return v.normalized();
  };
  for (Eigen::Index k = 0; k < d; ++k) {
    CellVector turn(d);
    for (double& x : turn) x = random.normal();
    const std::vector<int> corners = first_corners(points, cell);
    plane.rise = across(turn).transpose() * points.x;
    NextPoint next = next_point(points, cell, corners, plane);
    if (next.point < 0) plane.rise *= -1, next = next_point(points, cell, corners, plane);
    if (next.point < 0) throw BrokenCells();
    plane.level += next.way * plane.rise;
    const CellVector edge =
        across(points.x.col(next.point) - points.x.col(corners[points.summand[next.point]]));
    spanned.conservativeResize(d, k + 1);
    spanned.col(k) = edge;
    exchange(cell, -1, next.point);
  }
  return cell;
}

// The inverse, by Gauss-Jordan elimination.
// returns  the absolute value of the determinant
double invert(CellMatrix& m) {
  const Eigen::Index d = m.rows();
  const CellMatrix original = m;
  CellMatrix out = CellMatrix::Identity(d, d);
  double determinant = 1;
  for (Eigen::Index k = 0; k < d; ++k) {
    Eigen::Index pivot;
    m.col(k).tail(d - k).cwiseAbs().maxCoeff(&pivot);
    if (pivot > 0) m.row(k).swap(m.row(k + pivot)), out.row(k).swap(out.row(k + pivot));
    const double scale = m(k, k);
    if (scale == 0) throw BrokenCells();
    determinant *= scale;
    m.row(k) /= scale, out.row(k) /= scale;
    for (Eigen::Index i = 0; i < d; ++i) {
      if (i == k) continue;
      const double factor = m(i, k);
      m.row(i) -= factor * m.row(k), out.row(i) -= factor * out.row(k);
    }
  }
  // a step of Newton's method removes the rounding errors of the elimination
  m = out * (2 * CellMatrix::Identity(d, d) - original * out);
  return std::abs(determinant);
}

struct Surroundings {
  double volume = 0;  // of the cell
  std::vector<Cell> neighbors;
};

Surroundings look_around(const LiftedPoints& points, const Cell& cell) {
  const Eigen::Index d = points.dimension();
  const std::vector<int> first = first_corners(points, cell);
  // edges from the first corner of each simplex, and their slopes
  CellMatrix edges(d, d);
  CellVector falls(d);
  std::vector<int> sizes(points.summands, 0);
  Surroundings out{1, {}};
  Eigen::Index row = 0;
  for (const int i : cell) {
    const int s = points.summand[i];
    if (const int k = sizes[s]++; k > 0) {
      edges.row(row) = (points.x.col(i) - points.x.col(first[s])).transpose();
      falls[row++] = points.height[first[s]] - points.height[i];
      out.volume /= k;
    }
  }
  out.volume *= invert(edges);
  // all points in coordinates along the edges
  const Eigen::MatrixXd along = edges.transpose() * points.x;
  TurningPlane plane{points.height + (falls.transpose() * along).eval(), {}, {}};
  plane.least.resize(points.count());
  for (int i = 0; i < points.count(); ++i)
    plane.least[i] =
        rounding_rise * (1 + (along.col(i) - along.col(first[points.summand[i]])).lpNorm<1>());

  // across the wall opposite to each corner
  std::vector<Eigen::Index> rows(cell.size(), -1);
  row = 0;
  for (size_t k = 0; k < cell.size(); ++k)
    if (cell[k] != first[points.summand[cell[k]]]) rows[k] = row++;
  for (size_t k = 0; k < cell.size(); ++k) {
    const int s = points.summand[cell[k]];
    if (sizes[s] == 1) continue;
    CellVector by = CellVector::Zero(d);
    if (rows[k] >= 0)
      by[rows[k]] = -1;
    else  // all others of its simplex rise
      for (size_t j = 0; j < cell.size(); ++j)
        if (rows[j] >= 0 && points.summand[cell[j]] == s) by[rows[j]] = 1;
    plane.rise = by.transpose() * along / (edges.colwise().norm() * by.cwiseAbs());
    const NextPoint next = next_point(points, cell, first_corners(points, cell, cell[k]), plane);
    if (next.point < 0) continue;
    exchange(out.neighbors.emplace_back(cell), cell[k], next.point);
  }
  return out;
}

SumVolume cut_into_cells(const LiftedPoints& points, Random& random, int max_cells,
                         const Progress& progress) {
  SumVolume out{SumVolume::complete, 0, 0};
  std::vector<Cell> cells = {first_cell(points, random)};
  // index of a cell, and how many processed neighbors have reached it
  struct Entry {
    size_t number;
    int seen;
  };
  std::unordered_map<Cell, Entry, CellHash> entries = {{cells[0], {0, 0}}};
  for (size_t k = 0; k < cells.size(); ++k) {
    progress.check();
    const auto [volume, neighbors] = look_around(points, cells[k]);
    out.volume += volume;
    int known = 0;
    for (const Cell& next : neighbors) {
      const auto [entry, fresh] = entries.try_emplace(next, Entry{cells.size(), 0});
      if (fresh) cells.push_back(next);
      ++entry->second.seen;
      known += entry->second.number < k;
    }
    // adjacency must be mutual
    if (known != entries.at(cells[k]).seen) throw BrokenCells();
    if (static_cast<int>(cells.size()) > max_cells) return {SumVolume::too_many, 0, max_cells};
  }
  out.cells = static_cast<int>(cells.size());
  return out;
}

}  // namespace

SumVolume sum_volume(std::span<const Eigen::MatrixXd> summands, int max_cells,
                     const Progress& progress) {
  const Eigen::Index d = summands[0].rows();
  Eigen::Index count = 0, column = 0;
  for (const Eigen::MatrixXd& columns : summands) count += columns.cols();
  Eigen::MatrixXd edges(d, count);
  for (const Eigen::MatrixXd& columns : summands)
    for (const auto& p : columns.colwise()) edges.col(column++) = p - columns.col(0);
  const Svd svd = singular_value_decomposition(edges);
  if (svd.values.size() < d || svd.values[d - 1] <= flat * svd.values[0])
    return {SumVolume::complete, 0, 0};
  const Eigen::VectorXd lengths = svd.values / std::sqrt(static_cast<double>(count));
  const CellMatrix coordinates = lengths.cwiseInverse().asDiagonal() * svd.u.transpose();
  for (int attempt = 0; attempt < max_lifts; ++attempt) {
    Random random(static_cast<uint64_t>(attempt));
    try {
      SumVolume out =
          cut_into_cells(lift(summands, coordinates, random), random, max_cells, progress);
      out.volume *= lengths.prod();
      return out;
    } catch (const BrokenCells&) {
    }
  }
  return {};
}

}  // namespace clench
