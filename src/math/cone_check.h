// Checks the result of a cone program against what its status claims, in terms of the program
// itself.
#pragma once
#include "clench/math/cone_program.h"
#include "clench/math/scale_program.h"

namespace clench {

/// Tolerances of each equation, with data and rows scaled to about one: of an optimum; of a proof
/// of infeasibility, which does not exclude unknowns 1e12 times as large as the data; and of a
/// direction along which the objective decreases without limit.
inline constexpr double optimum_tolerance = 1e-9, proof_tolerance = 1e-12,
                        direction_tolerance = 1e-9;

/// The part of a program that was solved: without distant half-line constraints and redundant rows.
struct SolvedPart {
  std::vector<int> equations, unknowns, rows;  ///< of A, of x, of G; ascending
  ProgramSizes sizes;
};

/// Writes the residuals of its equations into the solution, in the program's own units; a solution
/// whose residuals exceed those allowed for its status becomes inaccurate.
/// scaled  size of each row and column
void check_solution(const ConeProgram& program, const ScaledProgram& scaled, const SolvedPart& part,
                    ConeSolution& solution);

}  // namespace clench
