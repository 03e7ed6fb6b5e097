// Random friction problems of all kinds.
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "clench/base/random.h"
#include "clench/dynamics/solve/friction_problem.h"
#include "clench/dynamics/solve/solve_friction.h"

namespace clench::test {

struct FrictionKind {
  int max_bodies = 3;
  int max_contacts = 12;
  double max_mu = 2;
  double mass_ratio = 1;   // between two bodies
  bool rows = true;        // joint limits, motors, equations
  bool duplicates = true;  // duplicate rows, of either sign
  bool consistent = true;  // velocities of rigid bodies, which impulses can stop
  double compliance = 0;   // added to the diagonal of W
};

inline int below(Random& random, int count) { return static_cast<int>(random.uniform() * count); }

inline Eigen::VectorXd normals(Random& random, int count) {
  Eigen::VectorXd v(count);
  for (double& x : v) x = random.normal();
  return v;
}

/// Free bodies that touch each other and the ground at random points with random normals.
inline FrictionProblem random_problem(Random& random, const FrictionKind& kind) {
  using Eigen::Vector3d, Eigen::VectorXd;
  const int bodies = 1 + below(random, kind.max_bodies),
            contacts = 1 + below(random, kind.max_contacts);
  const int rows = kind.rows ? below(random, 6) : 0;
  VectorXd mass(6 * bodies);
  for (int b = 0; b < bodies; ++b) {
    const double m = std::pow(kind.mass_ratio, random.uniform());
    for (int k = 0; k < 6; ++k) mass[6 * b + k] = k < 3 ? m : m * random.uniform(0.04, 0.44);
  }
  FrictionProblem problem;
  std::vector<VectorXd> jacobian;
  const auto next_row = [&] { return static_cast<int>(jacobian.size()); };
  for (int i = 0; i < contacts; ++i) {
    const int pick = below(random, 8);
    FrictionProblem::Block block{.row = next_row(), .tangents = pick == 0 ? 0 : pick <= 2 ? 3 : 2};
    block.mu = below(random, 8) == 0 ? 0 : random.uniform(0, kind.max_mu);
    if (kind.duplicates && i > 0 && below(random, 5) == 0) {
      const auto other = problem.blocks[below(random, i)];
      block.tangents = other.tangents;
      for (int k = 0; k < other.size(); ++k) jacobian.push_back(VectorXd(jacobian[other.row + k]));
    } else {
      const int a = below(random, bodies), b = below(random, bodies + 1);
      const Vector3d at_a = normals(random, 3), at_b = normals(random, 3),
                     n = normals(random, 3).normalized();
      const Vector3d directions[] = {n, n.unitOrthogonal(), n.cross(n.unitOrthogonal())};
      for (int k = 0; k < (block.tangents == 0 ? 1 : 3); ++k) {
        VectorXd row = VectorXd::Zero(6 * bodies);
        row.segment(6 * a, 6) << directions[k], at_a.cross(directions[k]);
        if (b < bodies && b != a)
          row.segment(6 * b, 6) << -directions[k], -at_b.cross(directions[k]);
        jacobian.push_back(row);
      }
      if (block.tangents == 3) {
        jacobian.push_back(VectorXd::Zero(6 * bodies));
        jacobian.back().segment(6 * a + 3, 3) = 0.1 * n;
      }
    }
    problem.blocks.push_back(block);
  }
  for (int i = 0; i < rows; ++i) {
    FrictionProblem::Block block{.row = next_row()};
    const int pick = below(random, 4);
    if (pick == 1) block.low = -1, block.high = 1;
    if (pick == 2) block.low = -block.high;
    if (pick == 3) block.low = -random.uniform(), block.high = below(random, 2) ? 0 : 0.3;
    if (kind.duplicates && below(random, 4) == 0)
      jacobian.push_back((below(random, 2) ? -1 : 1) * jacobian[below(random, next_row())]);
    else
      jacobian.push_back(normals(random, 6 * bodies));
    problem.blocks.push_back(block);
  }
  Eigen::MatrixXd J(next_row(), 6 * bodies);
  for (int i = 0; i < J.rows(); ++i) J.row(i) = jacobian[i];
  problem.q = J * normals(random, 6 * bodies);
  if (!kind.consistent) problem.q += normals(random, static_cast<int>(J.rows()));
  const Eigen::MatrixXd half = J * mass.cwiseInverse().cwiseSqrt().asDiagonal();
  problem.W = half * half.transpose();
  problem.W.diagonal().array() += kind.compliance;
  return problem;
}

/// The nearest point of |t| <= mu n: the point itself, the apex, or the nearest point on the only
/// candidate line of the boundary.
inline Eigen::VectorXd nearest_in_cone(const Eigen::VectorXd& p, double mu) {
  const Eigen::VectorXd t = p.tail(p.size() - 1);
  if (p[0] >= 0 && t.norm() <= mu * p[0]) return p;
  Eigen::VectorXd line(p.size());
  line << 1, mu * (t.norm() > 0 ? Eigen::VectorXd(t / t.norm()) : t);
  return std::max(0.0, line.dot(p) / line.squaredNorm()) * line;
}

/// Violation of each block's law, as a velocity, by an independent implementation.
inline Eigen::VectorXd faults(const FrictionProblem& problem, const Eigen::VectorXd& r) {
  const Eigen::VectorXd u = problem.W * r + problem.q;
  Eigen::VectorXd all(problem.blocks.size());
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    const double d = problem.W.diagonal().segment(block.row, block.size()).mean();
    Eigen::VectorXd here = r.segment(block.row, block.size()),
                    v = u.segment(block.row, block.size());
    if (block.is_contact()) {
      v[0] += block.mu * v.tail(block.tangents).norm();
      all[i] = (d * here - nearest_in_cone(d * here - v, block.mu)).norm();
    } else if (v[0] > 0) {
      all[i] = std::min(v[0], d * (here[0] - block.low));
    } else {
      all[i] = std::min(-v[0], d * (block.high - here[0]));
    }
    if (!block.is_contact() && (here[0] < block.low || here[0] > block.high)) all[i] = INFINITY;
  }
  return all;
}

// with a new solver, without stored state
inline FrictionSolution solve_friction(const FrictionProblem& problem,
                                       const Eigen::VectorXd& warm_start,
                                       const FrictionOptions& options = {}) {
  FrictionSolver solver;
  return solver.solve(problem, warm_start, options);
}

}  // namespace clench::test
