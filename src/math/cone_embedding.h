// The iterations of the cone-program solver: a homogeneous embedding that always has a solution.
#pragma once
#include <algorithm>

#include "clench/math/cone_kkt.h"
#include "clench/math/cone_program.h"

namespace clench {

/// Where the embedding is: x / tau solves the program when tau > 0, x or z proves that nothing does
/// when kappa > 0
struct ConePoint {
  Eigen::VectorXd x, z;  // z: one per row
  Eigen::VectorXd s;     // one per row of the cones
  double tau = 1, kappa = 1;
};

/// How well a point solves the program, or proves that nothing does; relative
struct ConeQuality {
  double primal = 0, dual = 0, gap = 0;  // as a solution
  double infeasible = 0, unbounded = 0;  // as a proof; infinite when it is none
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
