#include "clench/math/cone_check.h"

#include <algorithm>
#include <cmath>

#include "clench/math/cones.h"

namespace clench {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

// for zero rows, a vector of length zero, whatever the width
VectorXd times(const MatrixXd& m, const VectorXd& v, Eigen::Index rows) {
  return m.size() == 0 ? VectorXd(VectorXd::Zero(rows)) : VectorXd(m * v);
}

// distance outside of its cones; negative: inside
double outside(const ScaledProgram& scaled, const VectorXd& v) {
  return v.size() == 0 ? 0 : -cone_margin(scaled.cones, v);
}

// a solution and its products with the program's matrices, each in the units of its row or column
struct Terms {
  VectorXd x, y, z, s, Px, Ax, Gx, Aty, Gtz;
  VectorXd c, b, h;
};

Terms terms_of(const ConeProgram& p, const ScaledProgram& scaled, const SolvedPart& part,
               const ConeSolution& r) {
  const auto [primal, dual] = part.sizes;
  const auto n = p.c.size();
  Terms t;
  t.x = r.x.cwiseQuotient(scaled.columns) / primal;
  t.y = r.y.cwiseQuotient(scaled.rows_equal) / dual;
  t.z = r.z.cwiseQuotient(scaled.rows_cone) / dual;
  t.s = scaled.rows_cone.cwiseProduct(r.s) / primal;
  t.Px = scaled.columns.cwiseProduct(times(p.P, r.x, n)) / dual;
  t.Ax = scaled.rows_equal.cwiseProduct(times(p.A, r.x, p.b.size())) / primal;
  t.Gx = scaled.rows_cone.cwiseProduct(times(p.G, r.x, p.h.size())) / primal;
  t.Aty = scaled.columns.cwiseProduct(times(p.A.transpose(), r.y, n)) / dual;
  t.Gtz = scaled.columns.cwiseProduct(times(p.G.transpose(), r.z, n)) / dual;
  t.c = scaled.c / dual, t.b = scaled.b / primal, t.h = scaled.h / primal;
  return t;
}

// rounding is relative to the largest terms; but if they grow without limit, there is no solution
double against(double terms) { return std::clamp(terms, 1.0, 1e3); }

void check_optimum(const ScaledProgram& scaled, const SolvedPart& part, const Terms& t,
                   ConeSolution& out) {
  // for distant rows s is the remainder of h, and h alone would be their size
  const VectorXd missing = VectorXd(t.Gx + t.s - t.h)(part.rows);
  const double rows = against(std::max({max_norm(t.Ax), max_norm(VectorXd(t.Gx(part.rows)))}));
  out.primal_residual =
      std::max({max_norm(t.Ax - t.b), max_norm(missing), outside(scaled, t.s)}) / rows;
  const double columns = against(std::max({max_norm(t.Px), max_norm(t.Aty), max_norm(t.Gtz)}));
  out.dual_residual =
      std::max(max_norm(t.Px + t.c + t.Aty + t.Gtz), outside(scaled, t.z)) / columns;

  // relative to the objective, or, if its terms cancel, to those
  const double curved = t.x.dot(t.Px), linear = t.c.dot(t.x);
  const double above = curved / 2 + linear;
  const double below = -curved / 2 - t.b.dot(t.y) - t.h.dot(t.z);
  const double steepest = std::max(max_norm(t.c), max_norm(t.Px));
  const double size =
      std::max({gap_floor, std::abs(above), std::abs(below), steepest * max_norm(t.x)});
  out.gap = std::abs(above - below) / size;
}

bool is_finite(const ConeSolution& r) {
  return r.x.allFinite() && r.y.allFinite() && r.z.allFinite() && r.s.allFinite() &&
         std::isfinite(r.objective);
}

// does the point satisfy the claim of the status?
bool holds(const ScaledProgram& scaled, const SolvedPart& part, const Terms& t, ConeSolution& r) {
  if (r.status == ConeStatus::infeasible) {
    const double value = -(t.b.dot(t.y) + t.h.dot(t.z));
    const double off = std::max(max_norm(t.Aty + t.Gtz), outside(scaled, t.z));
    r.dual_residual = off / value;
    // for equations that nearly cancel the value is small: then sums are as accurate as rounding
    // permits
    const double rounding = 1e-15 * std::max(max_norm(t.y), max_norm(t.z));
    return value > 0 && off <= std::max(proof_tolerance * value, rounding);
  }
  if (r.status == ConeStatus::unbounded) {
    const double value = -t.c.dot(t.x);
    r.primal_residual =
        std::max({max_norm(t.Px), max_norm(t.Ax), max_norm(t.Gx + t.s), outside(scaled, t.s)}) /
        value;
    return value > 0 && r.primal_residual <= direction_tolerance;
  }
  check_optimum(scaled, part, t, r);
  return std::max({r.primal_residual, r.dual_residual, r.gap}) <= optimum_tolerance;
}

}  // namespace

void check_solution(const ConeProgram& program, const ScaledProgram& scaled, const SolvedPart& part,
                    ConeSolution& solution) {
  ConeSolution& r = solution;
  if (!is_finite(r) || !holds(scaled, part, terms_of(program, scaled, part, r), r))
    r.status = ConeStatus::inaccurate;
  else if (r.status == ConeStatus::inaccurate)
    r.status = ConeStatus::optimal;  // whatever stopped the solver
}

}  // namespace clench
