// Scales rows, columns and sizes of a cone program to about one, by powers of two: without
// rounding.
#pragma once
#include <optional>

#include "clench/math/cone_program.h"

namespace clench {

/// The same program in unknowns x' = x / columns, with rows multiplied by rows_equal and rows_cone
/// (one number per cone).
struct ScaledProgram {
  Eigen::MatrixXd P, A, G;
  Eigen::VectorXd c, b, h;
  std::vector<int> cones;  ///< all: a nonnegative row is a cone of size 1
  Eigen::VectorXd columns, rows_equal, rows_cone;
};

/// source  Ruiz (2001), A scaling algorithm to equilibrate both rows and columns norms in matrices
ScaledProgram scale_program(const ConeProgram& program);

/// The same with unknowns in the units of an approximate solution.
ScaledProgram scaled_to(ScaledProgram scaled, const Eigen::VectorXd& x);

/// Right sides are divided by primal, the objective by primal * dual: then both are about one.
struct ProgramSizes {
  double primal = 1, dual = 1;
};

/// b, h  right sides that are taken into account
ProgramSizes program_sizes(const ScaledProgram& scaled, const Eigen::VectorXd& b,
                           const Eigen::VectorXd& h);

/// Rows that depend on others, to 1e-10 of the largest.
struct RowDependence {
  std::vector<int> independent, dependent;            ///< ascending
  std::optional<Eigen::VectorXd> contradiction = {};  ///< y with A^T y = 0, b.y < 0
};

/// A, b  scaled to about one
RowDependence row_dependence(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace clench
