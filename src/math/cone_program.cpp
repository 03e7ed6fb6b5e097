#include "math/cone_program.h"

#include "base/error.h"
#include "math/cone_embedding.h"
#include "math/scale_program.h"

namespace clench {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;
using Sparse = SparseLdl::Matrix;

void check_program(const ConeProgram& program) {
  const auto n = program.c.size();
  const auto wrong = [](const std::string& why) { fail("cone program: {}", why); };
  const auto wanted_size = [&](const char* name, Eigen::Index got, Eigen::Index want) {
    if (got != want) wrong(fmt::format("{}: wanted {}, got {}", name, want, got));
  };
  if (program.P.size() > 0 || program.P.rows() > 0) {
    wanted_size("rows of P", program.P.rows(), n);
    wanted_size("columns of P", program.P.cols(), n);
  }
  wanted_size("rows of A", program.A.rows(), program.b.size());
  if (program.A.rows() > 0) wanted_size("columns of A", program.A.cols(), n);
  wanted_size("rows of G", program.G.rows(), program.h.size());
  if (program.G.rows() > 0) wanted_size("columns of G", program.G.cols(), n);
  Eigen::Index rows = program.nonnegative;
  if (program.nonnegative < 0)
    wrong(fmt::format("nonnegative must be >= 0, got {}", program.nonnegative));
  for (const int size : program.cones) {
    if (size < 1) wrong(fmt::format("a cone's size must be >= 1, got {}", size));
    rows += size;
  }
  wanted_size("rows of the cones", rows, program.h.size());
  const std::pair<const char*, bool> finite[] = {
      {"P", program.P.allFinite()}, {"c", program.c.allFinite()}, {"A", program.A.allFinite()},
      {"b", program.b.allFinite()}, {"G", program.G.allFinite()}, {"h", program.h.allFinite()}};
  for (const auto& [name, good] : finite)
    if (!good) wrong(fmt::format("{} holds a number that is not finite", name));
}

// rows of A as sparse columns; where a cone has a number in a column it has all of its rows
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

// what of the program is left after those equations and unknowns that say nothing new
struct Kept {
  std::vector<int> equations, unknowns;
};

ConeRows make_rows(const ScaledProgram& scaled, const Kept& kept) {
  ConeRows rows;
  const auto in_cones = scaled.h.size();
  const auto n = static_cast<int>(kept.unknowns.size());
  rows.equal = static_cast<int>(kept.equations.size());
  MatrixXd A(rows.equal + in_cones, n);
  rows.b.resize(rows.equal + in_cones);
  if (rows.equal > 0) A.topRows(rows.equal) = scaled.A(kept.equations, kept.unknowns);
  if (in_cones > 0) A.bottomRows(in_cones) = scaled.G(Eigen::all, kept.unknowns);
  rows.b.head(rows.equal) = scaled.b(kept.equations);
  rows.b.tail(in_cones) = scaled.h;
  rows.cones = scaled.cones;
  for (int c = 0; c < static_cast<int>(rows.cones.size()); ++c)
    rows.cone_at.insert(rows.cone_at.end(), rows.cones[c], c);
  rows.A = whole_cones(A, rows.equal, rows.cones);
  rows.At = rows.A.transpose();
  rows.P.resize(n, n);
  if (scaled.P.size() > 0) rows.P = MatrixXd(scaled.P(kept.unknowns, kept.unknowns)).sparseView();
  rows.q = scaled.c(kept.unknowns);
  return rows;
}

// equations that no x meets: y with A^T y = 0, b.y = -1
ConeSolution contradiction(const ConeProgram& program, const VectorXd& y) {
  ConeSolution out;
  out.status = ConeStatus::infeasible;
  out.x = VectorXd::Zero(program.c.size());
  out.z = out.s = VectorXd::Zero(program.h.size());
  out.y = y / -program.b.dot(y);
  out.dual_residual = (program.A.transpose() * out.y).norm();
  return out;
}

// back in the program's own units
ConeSolution unscaled(const ConeProgram& program, const ScaledProgram& scaled, const Kept& kept,
                      const EmbeddingEnd& end) {
  ConeSolution out;
  out.status = end.status;
  out.iterations = end.iterations;
  const ConePoint& p = end.point;
  const auto in_cones = scaled.h.size();
  const bool solved = end.status == ConeStatus::optimal || end.status == ConeStatus::inaccurate;
  const double over = solved ? 1 / p.tau : 1;
  const auto equal = static_cast<Eigen::Index>(kept.equations.size());
  out.x = VectorXd::Zero(scaled.c.size());
  out.x(kept.unknowns) = over * scaled.primal * p.x;
  out.x = out.x.cwiseProduct(scaled.columns);
  out.y = VectorXd::Zero(scaled.b.size());
  out.y(kept.equations) = over * scaled.dual * p.z.head(equal);
  out.y = out.y.cwiseProduct(scaled.rows_equal);
  out.z = over * scaled.dual * scaled.rows_cone.cwiseProduct(p.z.tail(in_cones));
  out.s = over * scaled.primal * p.s.cwiseQuotient(scaled.rows_cone);
  if (solved) {
    out.primal_residual = end.quality.primal;
    out.dual_residual = end.quality.dual;
    out.gap = end.quality.gap;
    out.objective = program.c.dot(out.x);
    if (program.P.size() > 0) out.objective += 0.5 * out.x.dot(program.P * out.x);
  } else if (end.status == ConeStatus::infeasible) {
    const double size = -(program.b.dot(out.y) + program.h.dot(out.z));
    out.y /= size, out.z /= size;
    out.x.setZero(), out.s.setZero();
    out.dual_residual = end.quality.infeasible;
  } else {
    const double size = -program.c.dot(out.x);
    out.x /= size, out.s /= size;
    out.y.setZero(), out.z.setZero();
    out.primal_residual = end.quality.unbounded;
  }
  return out;
}

// Unknowns whose columns are sums of others', in P, A and G: x moves along them and nothing notices but, perhaps,
// the objective.
struct Idle {
  std::vector<int> unknowns;
  std::vector<int> others;
  std::optional<VectorXd> falling = {};  // a direction that the objective falls along
};

Idle idle_unknowns(const ScaledProgram& scaled) {
  const auto n = scaled.c.size();
  MatrixXd columns(n, scaled.P.rows() + scaled.A.rows() + scaled.G.rows());
  columns << scaled.P.transpose(), scaled.A.transpose(), scaled.G.transpose();
  const RowDependence dependence = row_dependence(columns, scaled.c);
  Idle idle{dependence.dependent, dependence.independent, dependence.contradiction};
  return idle;
}

}  // namespace

// A solution, or one of the proofs; of a program that has neither solution nor bound, any of the two.
static ConeSolution solve_once(const ConeProgram& program) {
  const ScaledProgram scaled = scale_program(program);

  // equations that follow from others are left out; those that contradict them are the answer
  const RowDependence equations = row_dependence(scaled.A, scaled.b);
  if (equations.contradiction)
    return contradiction(program, scaled.rows_equal.cwiseProduct(*equations.contradiction));

  Kept kept{equations.independent, {}};
  for (int k = 0; k < scaled.c.size(); ++k) kept.unknowns.push_back(k);
  const ConeSolution all =
      unscaled(program, scaled, kept, solve_embedding(make_rows(scaled, kept)));
  if (all.status != ConeStatus::inaccurate) return all;

  // are there unknowns too many? to look for them takes longer than most programs
  const Idle idle = idle_unknowns(scaled);
  if (idle.unknowns.empty()) return all;
  kept.unknowns = idle.others;
  ConeSolution fewer = unscaled(program, scaled, kept, solve_embedding(make_rows(scaled, kept)));
  if (!idle.falling || fewer.status == ConeStatus::infeasible) return fewer;
  fewer.status = ConeStatus::unbounded;
  fewer.x = scaled.columns.cwiseProduct(*idle.falling);
  fewer.x /= -program.c.dot(fewer.x);
  fewer.y.setZero(), fewer.z.setZero(), fewer.s.setZero();
  fewer.objective = fewer.primal_residual = fewer.dual_residual = fewer.gap = 0;
  return fewer;
}

ConeSolution solve(const ConeProgram& program) {
  check_program(program);
  ConeSolution out = solve_once(program);
  if (out.status != ConeStatus::unbounded) return out;
  // the objective falls from any point that meets the constraints: does one?
  ConeProgram any = program;
  any.P.resize(0, 0);
  any.c.setZero();
  ConeSolution found = solve_once(any);
  return found.status == ConeStatus::infeasible ? found : out;
}

}  // namespace clench
