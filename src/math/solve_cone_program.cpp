#include "clench/math/solve_cone_program.h"

#include <limits>

#include "clench/base/error.h"
#include "clench/math/cone_check.h"
#include "clench/math/cone_embedding.h"
#include "clench/math/decompositions.h"

namespace clench {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;
using Sparse = SparseLdl::Matrix;

constexpr double no_end = std::numeric_limits<double>::infinity();

void check_program(const ConeProgram& program) {
  const auto n = program.c.size();
  const auto wrong = [](const std::string& why) { fail("cone program: {}", why); };
  const auto expected_size = [&](const char* name, Eigen::Index got, Eigen::Index want) {
    if (got != want) wrong(fmt::format("{}: expected {}, got {}", name, want, got));
  };
  if (program.P.size() > 0 || program.P.rows() > 0) {
    expected_size("rows of P", program.P.rows(), n);
    expected_size("columns of P", program.P.cols(), n);
  }
  expected_size("rows of A", program.A.rows(), program.b.size());
  if (program.A.rows() > 0) expected_size("columns of A", program.A.cols(), n);
  expected_size("rows of G", program.G.rows(), program.h.size());
  if (program.G.rows() > 0) expected_size("columns of G", program.G.cols(), n);
  Eigen::Index rows = program.nonnegative;
  if (program.nonnegative < 0)
    wrong(fmt::format("nonnegative must be >= 0, got {}", program.nonnegative));
  for (const int size : program.cones) {
    if (size < 1) wrong(fmt::format("a cone's size must be >= 1, got {}", size));
    rows += size;
  }
  expected_size("rows of the cones", rows, program.h.size());
  const std::pair<const char*, bool> finite[] = {
      {"P", program.P.allFinite()}, {"c", program.c.allFinite()}, {"A", program.A.allFinite()},
      {"b", program.b.allFinite()}, {"G", program.G.allFinite()}, {"h", program.h.allFinite()}};
  for (const auto& [name, good] : finite)
    if (!good) wrong(fmt::format("{} holds a number that is not finite", name));
}

// rows of A as sparse columns; a cone with an entry in a column has all of its rows there
Sparse whole_cones(const MatrixXd& A, int equal, const ConeSizes& cones) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < A.cols(); ++k) {
    for (int i = 0; i < equal; ++i)
      if (A(i, k) != 0) entries.emplace_back(i, k, A(i, k));
    int start = equal;
    for (const int size : cones) {
      if (!A.col(k).segment(start, size).isZero(0))
        for (int i = start; i < start + size; ++i) entries.emplace_back(i, k, A(i, k));
      start += size;
    }
  }
  Sparse out(A.rows(), A.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

ConeRows make_rows(const ScaledProgram& scaled, const SolvedPart& part) {
  ConeRows rows;
  const auto [primal, dual] = part.sizes;
  const auto in_cones = static_cast<Eigen::Index>(part.rows.size());
  const auto n = static_cast<int>(part.unknowns.size());
  rows.equal = static_cast<int>(part.equations.size());
  MatrixXd A(rows.equal + in_cones, n);
  rows.b.resize(rows.equal + in_cones);
  if (rows.equal > 0) A.topRows(rows.equal) = scaled.A(part.equations, part.unknowns);
  if (in_cones > 0) A.bottomRows(in_cones) = scaled.G(part.rows, part.unknowns);
  rows.b.head(rows.equal) = scaled.b(part.equations) / primal;
  rows.b.tail(in_cones) = scaled.h(part.rows) / primal;
  // a cone has all of its rows or none
  std::vector<int> cone_of;
  for (int c = 0; c < static_cast<int>(scaled.cones.size()); ++c)
    cone_of.insert(cone_of.end(), scaled.cones[c], c);
  for (size_t i = 0; i < part.rows.size();) {
    rows.cones.push_back(scaled.cones[cone_of[part.rows[i]]]);
    i += rows.cones.back();
  }
  for (int c = 0; c < static_cast<int>(rows.cones.size()); ++c)
    rows.cone_at.insert(rows.cone_at.end(), rows.cones[c], c);
  rows.A = whole_cones(A, rows.equal, rows.cones);
  rows.At = rows.A.transpose();
  rows.P.resize(n, n);
  if (scaled.P.size() > 0)
    rows.P = MatrixXd(scaled.P(part.unknowns, part.unknowns) * (primal / dual)).sparseView();
  rows.q = scaled.c(part.unknowns) / dual;
  return rows;
}

// y with A^T y = 0, b.y < 0, in the scaled equations
EmbeddingEnd contradiction(const ScaledProgram& scaled, const SolvedPart& part, const VectorXd& y) {
  EmbeddingEnd end;
  end.status = ConeStatus::infeasible;
  end.point.x = VectorXd::Zero(scaled.c.size());
  end.point.s = VectorXd::Zero(static_cast<Eigen::Index>(part.rows.size()));
  end.point.z = VectorXd::Zero(y.size() + end.point.s.size());
  end.point.z.head(y.size()) = y;
  return end;
}

// The smallest change of x that satisfies A x = b, as the last iterations lose digits: about as
// small as the residual, far within the tolerance of the cones.
void restore_equations(const MatrixXd& A, const VectorXd& b, VectorXd& x) {
  VectorXd left = b - A * x;
  for (int pass = 0; pass < 3; ++pass) {
    const double off = max_norm(left);
    if (!(off > 0)) return;
    const VectorXd next = x + A.transpose() * solve_symmetric(A * A.transpose(), left);
    left = b - A * next;
    if (!(max_norm(left) < 0.5 * off)) return;
    x = next;
  }
}

// The same for a proof, A^T y + G^T z = 0, with changes in proportion to the cone's distance from
// its boundary, so that what is barely inside stays there.
VectorXd restored_proof(const ConeRows& rows, const VectorXd& z) {
  VectorXd sizes = VectorXd::Constant(z.size(), z.lpNorm<Eigen::Infinity>());
  int start = rows.equal;
  for (const int size : rows.cones) {
    sizes.segment(start, size).setConstant(std::max(z[start], 1e-300));
    start += size;
  }
  VectorXd parts = z.cwiseQuotient(sizes);
  restore_equations(MatrixXd(rows.At) * sizes.asDiagonal(), VectorXd::Zero(rows.unknowns()), parts);
  const VectorXd better = sizes.cwiseProduct(parts);
  return cone_margin(rows.cones, better.tail(rows.in_cones())) >= 0 ? better : z;
}

// back in the program's own units, and checked there
ConeSolution unscaled(const ConeProgram& program, const ScaledProgram& scaled,
                      const SolvedPart& part, const EmbeddingEnd& end) {
  ConeSolution out;
  out.status = end.status;
  out.iterations = end.iterations;
  const ConePoint& p = end.point;
  const auto [primal, dual] = part.sizes;
  const bool solved = end.status == ConeStatus::optimal || end.status == ConeStatus::inaccurate;
  const double over = solved ? 1 / p.tau : 1;
  const auto equal = static_cast<Eigen::Index>(part.equations.size());
  const auto in_cones = static_cast<Eigen::Index>(part.rows.size());
  out.units = primal * scaled.columns;
  out.x = VectorXd::Zero(scaled.c.size());
  out.x(part.unknowns) = over * primal * p.x;
  if (solved && equal > 0)
    restore_equations(scaled.A(part.equations, Eigen::all), scaled.b(part.equations), out.x);
  VectorXd both = p.z;
  if (end.status == ConeStatus::infeasible && end.quality.infeasible > 0.01 * proof_tolerance)
    both = restored_proof(make_rows(scaled, part), p.z);
  out.x = out.x.cwiseProduct(scaled.columns);
  out.y = VectorXd::Zero(scaled.b.size());
  out.y(part.equations) = over * dual * both.head(equal);
  out.y = out.y.cwiseProduct(scaled.rows_equal);
  out.z = VectorXd::Zero(scaled.h.size());
  out.z(part.rows) = over * dual * both.tail(in_cones);
  out.z = out.z.cwiseProduct(scaled.rows_cone);
  VectorXd s = (over * primal * p.s).cwiseQuotient(VectorXd(scaled.rows_cone(part.rows)));
  if (end.status == ConeStatus::infeasible) {
    const double size = -(program.b.dot(out.y) + program.h.dot(out.z));
    out.y /= size, out.z /= size;
    out.x.setZero(), s.setZero();
  } else if (end.status == ConeStatus::unbounded) {
    const double size = -program.c.dot(out.x);
    out.x /= size, s /= size;
    out.y.setZero(), out.z.setZero();
  } else if (end.status == ConeStatus::optimal && program.b.isZero(0) &&
             VectorXd(program.h(part.rows)).isZero(0) && program.P.isZero(0)) {
    // without an objective and without unbounded directions, 0 is optimal
    out.x.setZero(), s.setZero();
  }
  // slacks of rows that were omitted
  out.s = (solved ? 1 : 0) * program.h;
  if (program.G.size() > 0) out.s -= program.G * out.x;
  out.s(part.rows) = s;
  if (solved) {
    out.objective = program.c.dot(out.x);
    if (program.P.size() > 0) out.objective += 0.5 * out.x.dot(program.P * out.x);
  }
  check_solution(program, scaled, part, out);
  return out;
}

// Unknowns whose columns are combinations of others', in P, A and G: moving x along them changes
// nothing except, perhaps, the objective.
struct Idle {
  std::vector<int> unknowns;
  std::vector<int> others;
  std::optional<VectorXd> falling = {};  // a direction along which the objective decreases
};

Idle idle_unknowns(const ScaledProgram& scaled) {
  const auto n = scaled.c.size();
  MatrixXd columns(n, scaled.P.rows() + scaled.A.rows() + scaled.G.rows());
  columns << scaled.P.transpose(), scaled.A.transpose(), scaled.G.transpose();
  const RowDependence dependence = row_dependence(columns, scaled.c);
  Idle idle{dependence.dependent, dependence.independent, dependence.contradiction};
  return idle;
}

// residuals from which a second start may reach an optimum
constexpr double nearly = 1e-6;

// a half line whose right side is this many times the others' is seldom active
constexpr double far = 100;

std::vector<int> numbers_to(Eigen::Index count) {
  std::vector<int> out(static_cast<size_t>(count));
  for (size_t k = 0; k < out.size(); ++k) out[k] = static_cast<int>(k);
  return out;
}

// half lines (cones of one row) that x = 0 satisfies with a margin
std::vector<int> roomy_rows(const ScaledProgram& scaled) {
  std::vector<int> out;
  int start = 0;
  for (const int size : scaled.cones) {
    if (size == 1 && scaled.h[start] > 0) out.push_back(start);
    start += size;
  }
  return out;
}

ConeSolution solve_part(const ConeProgram& program, const ScaledProgram& scaled, SolvedPart part) {
  part.sizes = program_sizes(scaled, scaled.b, scaled.h(part.rows));
  part.unknowns = numbers_to(scaled.c.size());
  // redundant equations are omitted; contradictory ones are the result
  const RowDependence equations = row_dependence(scaled.A, scaled.b / part.sizes.primal);
  if (equations.contradiction) {
    part.equations = numbers_to(scaled.b.size());
    return unscaled(program, scaled, part, contradiction(scaled, part, *equations.contradiction));
  }
  part.equations = equations.independent;
  ConeSolution all = unscaled(program, scaled, part, solve_embedding(make_rows(scaled, part)));
  if (all.status != ConeStatus::inaccurate) return all;

  // nearly converged? then again in the units of that point
  if (std::max({all.primal_residual, all.dual_residual, all.gap}) < nearly) {
    const ScaledProgram again = scaled_to(scaled, all.x);
    SolvedPart same = part;
    same.sizes = program_sizes(again, again.b, again.h(part.rows));
    const ConeSolution better =
        unscaled(program, again, same, solve_embedding(make_rows(again, same)));
    if (better.status == ConeStatus::optimal) return better;
  }

  // are there redundant unknowns? the search takes longer than most programs
  const Idle idle = idle_unknowns(scaled);
  if (idle.unknowns.empty()) return all;
  part.unknowns = idle.others;
  ConeSolution fewer = unscaled(program, scaled, part, solve_embedding(make_rows(scaled, part)));
  if (!idle.falling || fewer.status == ConeStatus::infeasible) return fewer;
  fewer.status = ConeStatus::unbounded;
  fewer.x = scaled.columns.cwiseProduct(*idle.falling);
  fewer.x /= -program.c.dot(fewer.x);
  fewer.y.setZero(), fewer.z.setZero(), fewer.s.setZero();
  fewer.objective = fewer.primal_residual = fewer.dual_residual = fewer.gap = 0;
  check_solution(program, scaled, part, fewer);
  return fewer;
}

// right side above which half lines are omitted at first: by the size of the other right sides or,
// if these are all zero, by the smallest one of a half line
double first_limit(const ScaledProgram& scaled, const std::vector<int>& roomy) {
  VectorXd asked(scaled.b.size() + scaled.h.size());
  asked << scaled.b, scaled.h;
  double nearest = no_end;
  for (const int row : roomy) {
    nearest = std::min(nearest, scaled.h[row]);
    asked[scaled.b.size() + row] = 0;
  }
  return far * (asked.isZero(0) ? nearest : asked.lpNorm<Eigen::Infinity>());
}

// A solution, or one of the proofs; for a program that is both infeasible and unbounded, either of
// them. Distant half lines are omitted, since they would determine the scale, and added when they
// are active or needed.
ConeSolution solve_once(const ConeProgram& program) {
  const ScaledProgram scaled = scale_program(program);
  const std::vector<int> roomy = roomy_rows(scaled);
  double limit = first_limit(scaled, roomy);
  for (;;) {
    SolvedPart part;
    part.rows = numbers_to(scaled.h.size());
    double next = no_end;  // the nearest omitted one
    std::erase_if(part.rows, [&](int row) {
      if (scaled.h[row] <= limit || !std::ranges::binary_search(roomy, row)) return false;
      next = std::min(next, scaled.h[row]);
      return true;
    });
    ConeSolution out = solve_part(program, scaled, part);
    if (next == no_end || out.status == ConeStatus::infeasible) return out;
    if (out.status == ConeStatus::optimal && out.s(roomy).minCoeff() >= 0) return out;
    limit = far * next;
  }
}

}  // namespace

ConeSolution solve(const ConeProgram& program) {
  check_program(program);
  ConeSolution out = solve_once(program);
  if (out.status != ConeStatus::unbounded) return out;
  // the objective decreases from any feasible point: is there one?
  ConeProgram any = program;
  any.P.resize(0, 0);
  any.c.setZero();
  ConeSolution found = solve_once(any);
  return found.status == ConeStatus::infeasible ? found : out;
}

}  // namespace clench
