#include "clench/dynamics/solve/friction_pyramid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/math/decompositions.h"
#include "clench/math/lcp.h"
#include "clench/math/product.h"

namespace clench {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd pyramid_directions(int tangents, int edges) {
  // a bounded row has none
  MatrixXd directions(std::max(tangents, 0), tangents == 2   ? edges
                                             : tangents == 3 ? 3 * edges - 4
                                                             : 0);
  int column = 0;
  const auto ring = [&](int count, double latitude) {
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      directions(0, column) = std::cos(latitude) * std::cos(angle);
      directions(1, column) = std::cos(latitude) * std::sin(angle);
      if (tangents == 3) directions(2, column) = std::sin(latitude);
      ++column;
    }
  };
  if (tangents == 3) {
    directions.col(column++) = Eigen::Vector3d(0, 0, 1);
    ring(edges - 3, std::numbers::pi / 4);
  }
  if (tangents >= 2) ring(edges, 0);
  if (tangents == 3) {
    ring(edges - 3, -std::numbers::pi / 4);
    directions.col(column++) = Eigen::Vector3d(0, 0, -1);
  }
  return directions;
}

namespace {

/// r = start + rows x; w = M x + q, with additional unknowns for lambda and for the upper bounds of
/// rows.
struct Complementarity {
  MatrixXd rows;  // r by x
  VectorXd start;
  MatrixXd coupling;  // of M, in addition to rows^T S rows
  VectorXd offset;    // of q, in addition to rows^T (S start + q)
  VectorXd units;     // velocity of the problem that is 1 in w
};

int count_unknowns(const ScaledFriction& problem, const std::vector<MatrixXd>& edges) {
  int count = 0;
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    if (!block.moves) continue;
    if (block.is_contact())
      count += block.mu > 0 && block.tangents > 0 ? 2 + static_cast<int>(edges[i].cols()) : 1;
    else if (std::isfinite(block.low) || std::isfinite(block.high))
      count += std::isfinite(block.low) && std::isfinite(block.high) ? 2 : 1;
  }
  return count;
}

Complementarity put_together(const ScaledFriction& problem, const std::vector<MatrixXd>& edges) {
  const int count = count_unknowns(problem, edges), n = problem.rows();
  Complementarity c{.rows = MatrixXd::Zero(n, count),
                    .start = VectorXd::Zero(n),
                    .coupling = MatrixXd::Zero(count, count),
                    .offset = VectorXd::Zero(count),
                    .units = VectorXd::Zero(count)};
  int x = 0;
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    const int row = block.row, first = x;
    if (!block.moves) continue;
    if (block.is_contact()) {
      c.rows(row, x++) = 1;
      if (block.mu > 0 && block.tangents > 0) {
        const int many = static_cast<int>(edges[i].cols()), lambda = x + many;
        c.rows.block(row + 1, x, block.tangents, many) = edges[i];
        c.coupling.col(lambda).segment(x, many).setOnes();
        c.coupling.row(lambda).segment(x, many).setConstant(-1);
        c.coupling(lambda, first) = block.mu;
        x = lambda + 1;
      }
    } else if (std::isfinite(block.low)) {
      c.rows(row, x++) = 1;
      c.start[row] = block.low;
      if (std::isfinite(block.high)) {
        c.coupling(first, x) = 1, c.coupling(x, first) = -1;
        c.offset[x++] = block.high - block.low;
      }
    } else if (std::isfinite(block.high)) {
      c.rows(row, x++) = -1;
      c.start[row] = block.high;
    }
    c.units.segment(first, x - first).setConstant(1 / problem.units[row]);
  }
  return c;
}

// Positive unknowns stay positive, and their velocities are reduced to 0 by steps of minimum norm.
template <typename Velocities>
void take_damping_away(const MatrixXd& damped, const Velocities& velocities, VectorXd& z) {
  std::vector<int> above;
  for (int i = 0; i < z.size(); ++i)
    if (z[i] > 0) above.push_back(i);
  if (above.empty()) return;
  const DenseLu factors(damped(above, above));
  for (int round = 0; round < 3; ++round) {
    const VectorXd next = z(above) - factors.solve(velocities(z)(above));
    if (!(next.minCoeff() >= 0)) return;
    z(above) = next;
  }
}

}  // namespace

std::vector<FrictionProblem::Block> inscribed_cones(std::vector<FrictionProblem::Block> blocks,
                                                    int edges) {
  const double polygon = std::cos(std::numbers::pi / edges);
  // the equator with the two poles is a double pyramid, which the other directions only enlarge
  const double with_torsion = polygon / std::sqrt(1 + polygon * polygon);
  for (auto& block : blocks)
    if (block.tangents > 0) block.mu *= block.tangents == 2 ? polygon : with_torsion;
  return blocks;
}

// Largest number of unknowns; time of a pivot and memory are quadratic in it.
static constexpr int max_unknowns = 6000;

PyramidSolution solve_pyramid(const ScaledFriction& problem, double damping, const VectorXd& center,
                              const std::vector<MatrixXd>& edges) {
  if (const int count = count_unknowns(problem, edges); count > max_unknowns)
    fail(ErrorKind::limit,
         "dynamics: cone 'pyramid': expected at most {} edges and bounds in a group of touching "
         "bodies, got {}; use cone 'round' or fewer edges",
         max_unknowns, count);
  Complementarity c = put_together(problem, edges);
  MatrixXd S = problem.S;
  S.diagonal() += damping * problem.weights;
  const VectorXd pulled = problem.q - damping * problem.weights.cwiseProduct(center);
  // rows without bounds are equations: their r follows from the others, as u is 0
  std::vector<int> free;
  for (const auto& block : problem.blocks)
    if (!block.is_contact() && block.moves && std::isinf(block.low) && std::isinf(block.high))
      free.push_back(block.row);
  const int count = static_cast<int>(free.size());
  if (count > 0) {
    MatrixXd part(count, count), right(count, c.rows.cols() + 1);
    const MatrixXd by_unknowns = product(S, c.rows);
    const VectorXd by_start = S * c.start + pulled;
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) part(i, j) = S(free[i], free[j]);
      right.row(i) << by_unknowns.row(free[i]), by_start[free[i]];
    }
    const MatrixXd share = solve_symmetric(part, right);
    for (int i = 0; i < count; ++i) {
      c.rows.row(free[i]) = -share.row(i).head(c.rows.cols());
      c.start[free[i]] = -share(i, c.rows.cols());
    }
  }
  const MatrixXd M = product(product(c.rows.transpose(), S), c.rows) + c.coupling;
  const VectorXd q = c.rows.transpose() * (S * c.start + pulled) + c.offset;
  LcpSolution lcp = solve_lcp(M, q);
  PyramidSolution solution;
  solution.found = lcp.status == LcpStatus::solved;
  solution.iterations = lcp.iterations;
  const auto without_damping = [&](const VectorXd& z) -> VectorXd {
    return c.rows.transpose() * (problem.S * (c.start + c.rows * z) + problem.q) + c.coupling * z +
           c.offset;
  };
  if (solution.found) take_damping_away(M, without_damping, lcp.z);
  solution.r = c.start + c.rows * lcp.z;
  const VectorXd w = without_damping(lcp.z);
  for (int i = 0; i < w.size(); ++i)
    solution.residual =
        std::max(solution.residual, std::abs(std::min(lcp.z[i], w[i])) * c.units[i]);
  const VectorXd u = problem.S * solution.r + problem.q;
  for (const int row : free)
    solution.residual = std::max(solution.residual, std::abs(u[row]) / problem.units[row]);
  return solution;
}

}  // namespace clench
