#include "clench/math/scale_program.h"

#include <algorithm>
#include <cmath>

#include "clench/math/decompositions.h"

namespace clench {

using Eigen::MatrixXd, Eigen::VectorXd;

// weights of rows in a dependent row; the right sides must then agree to ten times that
static constexpr double depends = 1e-10, agrees = 1e-9;

// 0 counts as 1
static double power_of_two(double x) { return x > 0 ? std::exp2(std::round(std::log2(x))) : 1; }

// the norm that a factor normalizes; an empty row keeps its factor
static double factor_for(double norm) { return norm > 0 ? 1 / std::sqrt(norm) : 1; }

// one factor per cone, so that it remains a cone
static void even_out(const std::vector<int>& cones, VectorXd& norms) {
  int start = 0;
  for (const int size : cones) {
    norms.segment(start, size).setConstant(norms.segment(start, size).maxCoeff());
    start += size;
  }
}

static void multiply(ScaledProgram& p, const VectorXd& columns, const VectorXd& rows_equal,
                     const VectorXd& rows_cone) {
  if (p.P.size() > 0) p.P = columns.asDiagonal() * p.P * columns.asDiagonal();
  if (p.A.size() > 0) p.A = rows_equal.asDiagonal() * p.A * columns.asDiagonal();
  if (p.G.size() > 0) p.G = rows_cone.asDiagonal() * p.G * columns.asDiagonal();
  p.columns = p.columns.cwiseProduct(columns);
  p.rows_equal = p.rows_equal.cwiseProduct(rows_equal);
  p.rows_cone = p.rows_cone.cwiseProduct(rows_cone);
}

// Half lines that bound a single unknown fit any unit: they are ignored here.
static std::vector<bool> single_bounds(const ScaledProgram& p) {
  std::vector<bool> single(static_cast<size_t>(p.h.size()), false);
  Eigen::Index start = 0;
  for (const int size : p.cones) {
    single[start] = size == 1 && (p.G.row(start).array() != 0).count() <= 1;
    start += size;
  }
  return single;
}

// every row and column towards a largest entry of one
static void equilibrate(ScaledProgram& p) {
  const auto n = p.c.size();
  const std::vector<bool> single = single_bounds(p);
  for (int pass = 0; pass < 12; ++pass) {
    VectorXd columns = VectorXd::Zero(n), rows_equal(p.b.size()), rows_cone(p.h.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      if (p.A.size() > 0) columns[k] = std::max(columns[k], max_norm(p.A.col(k)));
      for (Eigen::Index i = 0; i < p.G.rows(); ++i)
        if (!single[i]) columns[k] = std::max(columns[k], std::abs(p.G(i, k)));
    }
    for (Eigen::Index k = 0; k < p.b.size(); ++k) rows_equal[k] = max_norm(p.A.row(k));
    for (Eigen::Index k = 0; k < p.h.size(); ++k) rows_cone[k] = max_norm(p.G.row(k));
    even_out(p.cones, rows_cone);
    const auto to_power = [](double norm) { return power_of_two(factor_for(norm)); };
    multiply(p, columns.unaryExpr(to_power), rows_equal.unaryExpr(to_power),
             rows_cone.unaryExpr(to_power));
  }
}

// Each unknown in the units of the cones that contain it: narrow and wide ones become round.
static void round_cones(ScaledProgram& p) {
  VectorXd norms = VectorXd::Zero(p.c.size());
  Eigen::Index start = 0;
  for (const int size : p.cones) {
    if (size > 1)
      for (Eigen::Index k = 0; k < norms.size(); ++k)
        norms[k] = std::max(norms[k], max_norm(p.G.col(k).segment(start, size)));
    start += size;
  }
  const VectorXd columns =
      norms.unaryExpr([](double norm) { return power_of_two(norm > 0 ? 1 / norm : 1); });
  multiply(p, columns, VectorXd::Ones(p.b.size()), VectorXd::Ones(p.h.size()));
}

// every row to a largest entry of one
static void equilibrate_rows(ScaledProgram& p) {
  VectorXd rows_equal(p.b.size()), rows_cone(p.h.size());
  for (Eigen::Index k = 0; k < p.b.size(); ++k) rows_equal[k] = max_norm(p.A.row(k));
  for (Eigen::Index k = 0; k < p.h.size(); ++k) rows_cone[k] = max_norm(p.G.row(k));
  even_out(p.cones, rows_cone);
  const auto to_power = [](double norm) { return power_of_two(norm > 0 ? 1 / norm : 1); };
  multiply(p, VectorXd::Ones(p.c.size()), rows_equal.unaryExpr(to_power),
           rows_cone.unaryExpr(to_power));
}

// with the original right sides and objective
static void rescale(ScaledProgram& p, const VectorXd& columns) {
  const VectorXd before = p.columns, equal = p.rows_equal, cone = p.rows_cone;
  multiply(p, columns, VectorXd::Ones(p.b.size()), VectorXd::Ones(p.h.size()));
  equilibrate_rows(p);
  p.c = p.c.cwiseProduct(p.columns.cwiseQuotient(before));
  p.b = p.b.cwiseProduct(p.rows_equal.cwiseQuotient(equal));
  p.h = p.h.cwiseProduct(p.rows_cone.cwiseQuotient(cone));
}

ScaledProgram scaled_to(ScaledProgram scaled, const VectorXd& x) {
  const VectorXd own = x.cwiseQuotient(scaled.columns).cwiseAbs();
  const double most = max_norm(own);
  // a thousandth of the largest may be rounding
  if (most > 0)
    rescale(scaled,
            own.unaryExpr([&](double v) { return power_of_two(std::max(v / most, 1e-3)); }));
  return scaled;
}

ScaledProgram scale_program(const ConeProgram& program) {
  ScaledProgram p;
  p.P = program.P, p.A = program.A, p.G = program.G;
  p.c = program.c, p.b = program.b, p.h = program.h;
  // empty matrices have the right width
  for (MatrixXd* m : {&p.P, &p.A, &p.G})
    if (m->size() == 0) m->resize(m == &p.P ? 0 : m->rows(), p.c.size());
  p.cones.assign(program.nonnegative, 1);
  p.cones.insert(p.cones.end(), program.cones.begin(), program.cones.end());
  p.columns.setOnes(p.c.size());
  p.rows_equal.setOnes(p.b.size());
  p.rows_cone.setOnes(p.h.size());
  round_cones(p);
  equilibrate(p);
  p.c = p.columns.cwiseProduct(p.c);
  p.b = p.rows_equal.cwiseProduct(p.b);
  p.h = p.rows_cone.cwiseProduct(p.h);
  return p;
}

ProgramSizes program_sizes(const ScaledProgram& scaled, const VectorXd& b, const VectorXd& h) {
  ProgramSizes sizes;
  const double slope = max_norm(scaled.c);
  const double curvature = scaled.P.size() == 0 ? 0 : scaled.P.cwiseAbs().maxCoeff();
  double size = std::max(max_norm(b), max_norm(h));
  if (size == 0 && curvature > 0) size = slope / curvature;
  sizes.primal = power_of_two(size);
  sizes.dual = power_of_two(std::max(slope, curvature * sizes.primal));
  return sizes;
}

RowDependence row_dependence(const MatrixXd& A, const VectorXd& b) {
  RowDependence out;
  if (A.rows() == 0) return out;
  const IndependentRows rows = independent_rows(A, depends);
  out.independent = rows.rows;
  out.dependent = rows.others;
  // each of the others is a combination of the independent ones, and b must be the same combination
  double worst =
      agrees * std::max(1.0, rows.weights.size() > 0 ? rows.weights.cwiseAbs().maxCoeff() : 0);
  for (size_t k = 0; k < rows.others.size(); ++k) {
    VectorXd y = VectorXd::Zero(b.size());
    y[rows.others[k]] = 1;
    for (size_t i = 0; i < rows.rows.size(); ++i)
      y[rows.rows[i]] = -rows.weights(static_cast<int>(k), static_cast<int>(i));
    const double off = b.dot(y);
    if (std::abs(off) <= worst) continue;
    worst = std::abs(off);
    out.contradiction = off > 0 ? VectorXd(-y) : y;
  }
  return out;
}

}  // namespace clench
