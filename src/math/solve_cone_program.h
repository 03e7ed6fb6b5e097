// Solves cone programs.
#pragma once
#include "clench/math/cone_program.h"

namespace clench {

/// Primal-dual interior points in a homogeneous embedding, so that what has no solution is proved
/// to have none. Redundant, zero and badly scaled rows and columns are no trouble, nor half lines
/// far away, which are left out while they do not bind. What is handed out has been checked at the
/// program itself. The same bits every time.
///
/// throws  Error when sizes do not fit or a number is not finite
/// source  Nesterov & Todd (1997); Mehrotra (1992); Goulart & Chen (2024), Clarabel: an
///         interior-point solver for conic programs with quadratic objectives
ConeSolution solve(const ConeProgram& program);

}  // namespace clench
