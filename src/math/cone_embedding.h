// Iterations of the cone-program solver: a homogeneous embedding that always has a solution.
#pragma once
#include <algorithm>

#include "clench/math/cone_kkt.h"
#include "clench/math/cone_program.h"

namespace clench {

/// A point of the embedding: x / tau solves the program if tau > 0, x or z proves that there is no
/// solution if kappa > 0
struct ConePoint {
  Eigen::VectorXd x, z;  // z: one per row
  Eigen::VectorXd s;     // one per row of the cones
  double tau = 1, kappa = 1;
};

/// Relative residuals of a point as a solution of the program, and as a proof that there is none.
struct ConeQuality {
  double primal = 0, dual = 0, gap = 0;  // as a solution
  double infeasible = 0, unbounded = 0;  // as a proof; infinite if it is not one
  double worst() const { return std::max({primal, dual, gap}); }
  double proof() const { return std::min(infeasible, unbounded); }
};

/// optimal: point.x / tau solves it; infeasible: point.z proves it; unbounded: point.x does;
/// inaccurate: the best point
struct EmbeddingEnd {
  ConeStatus status = ConeStatus::inaccurate;
  ConePoint point;
  ConeQuality quality;
  int iterations = 0;
};

/// rows  scaled to about one
/// source  Goulart & Chen (2024), Clarabel: an interior-point solver for conic programs with
///         quadratic objectives
EmbeddingEnd solve_embedding(const ConeRows& rows);

}  // namespace clench
