// Solves cone programs.
#pragma once
#include "clench/math/cone_program.h"

namespace clench {

/// Primal-dual interior-point method in a homogeneous embedding, so that infeasibility is proved.
/// Handles redundant, zero and badly scaled rows and columns, and distant half-line constraints,
/// which are omitted while they are inactive. Results are checked against the original program.
/// Equal programs give bit-identical results.
///
/// throws  Error if sizes do not match or a number is not finite
/// source  Nesterov & Todd (1997); Mehrotra (1992); Goulart & Chen (2024), Clarabel: an
///         interior-point solver for conic programs with quadratic objectives
ConeSolution solve(const ConeProgram& program);

}  // namespace clench
