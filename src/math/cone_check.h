// How far an answer to a cone program is from what its status says, measured at the program itself.
#pragma once
#include "clench/math/cone_program.h"
#include "clench/math/scale_program.h"

namespace clench {

/// What an optimum may be off in each of its equations, with data and rows scaled to about one; a
/// proof that there is no solution, which says nothing of unknowns 1e12 times as large as the data;
/// and a direction that the objective falls along.
inline constexpr double optimum_tolerance = 1e-9, proof_tolerance = 1e-12,
                        direction_tolerance = 1e-9;

/// The part of a program that an answer came from: all of it but half lines far away and what
/// follows from the rest.
struct SolvedPart {
  std::vector<int> equations, unknowns, rows;  ///< of A, of x, of G; ascending
  ProgramSizes sizes;
};

/// Writes into the solution what its equations miss, from the program's own numbers; what misses
/// more than the status promises becomes inaccurate.
/// scaled  how large each row and column is
void check_solution(const ConeProgram& program, const ScaledProgram& scaled, const SolvedPart& part,
                    ConeSolution& solution);

}  // namespace clench
