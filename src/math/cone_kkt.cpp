#include "clench/math/cone_kkt.h"

#include "clench/math/cone_program.h"

namespace clench {

using Eigen::MatrixXd, Eigen::VectorXd;

static constexpr double trusted = 1e-10;  // residual allowed for a fast solution
static constexpr double regular = 1e-12;  // keeps pivots away from 0; refinement removes its effect

static SparseLdl::Matrix lower_pattern(const ConeRows& rows) {
  const int n = rows.unknowns();
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n + rows.count(); ++i) entries.emplace_back(i, i, i < n ? 0.0 : -1.0);
  for (int k = 0; k < n; ++k) {
    for (SparseLdl::Matrix::InnerIterator it(rows.P, k); it; ++it)
      if (it.row() >= k) entries.emplace_back(it.row(), k, it.value());
    for (SparseLdl::Matrix::InnerIterator it(rows.A, k); it; ++it)
      entries.emplace_back(n + it.row(), k, it.value());
  }
  SparseLdl::Matrix lower(n + rows.count(), n + rows.count());
  lower.setFromTriplets(entries.begin(), entries.end());
  lower.makeCompressed();
  return lower;
}

ConeKkt::ConeKkt(const ConeRows& rows) : rows_(rows), lower_(lower_pattern(rows)), ldl_(lower_) {}

bool ConeKkt::factor(const NesterovTodd& scaling) {
  scaling_ = &scaling;
  lu_.reset();
  for (double extra = regular; extra < 1e-3; extra *= 100) {
    fill(extra);
    if (ldl_.factor(lower_)) return true;
  }
  return false;
}

template <class Solver>
ConeKkt::Solution ConeKkt::refined(const VectorXd& right, Solver solver) const {
  Solution out;
  out.value = solver(right);
  VectorXd left = right - times(out.value);
  out.off = max_norm(left);
  for (int i = 0; i < 12 && out.off > 1e-15 * max_norm(right); ++i) {
    const VectorXd better = out.value + solver(left);
    left = right - times(better);
    const double before = out.off, off = max_norm(left);
    if (!(off < before)) break;
    out = {better, off};
    if (off > 0.5 * before) break;
  }
  return out;
}

const DenseLu& ConeKkt::lu() const {
  if (!lu_) {
    const MatrixXd lower = lower_;
    lu_.emplace(MatrixXd(lower.selfadjointView<Eigen::Lower>()));
  }
  return *lu_;
}

VectorXd ConeKkt::solve(const VectorXd& right) const {
  const auto quick = [&](const VectorXd& r) { return ldl_.solve(r); };
  Solution out = refined(right, quick);
  if (out.off <= trusted * max_norm(right)) return out.value;
  // with pivoting, if the sparse ordering fails
  const auto careful = [&](const VectorXd& r) -> VectorXd { return lu().solve(r); };
  const Solution again = refined(right, careful);
  return again.off < out.off ? again.value : out.value;
}

// the diagonal is first in each column of the lower triangle, the rows of A last
void ConeKkt::fill(double extra) {
  const int n = rows_.unknowns();
  double* values = lower_.valuePtr();
  const int* ends = lower_.outerIndexPtr();
  for (int k = 0; k < n; ++k) {
    values[ends[k]] = rows_.P.coeff(k, k) + extra;
    scale_column(k, values + ends[k + 1]);
  }
  for (int k = 0; k < rows_.count(); ++k)
    values[ends[n + k]] = k < rows_.equal ? -extra : -1 - extra;
}

// W^-1 times a column of A, before `end`; A contains complete cones
void ConeKkt::scale_column(int k, double* end) {
  const int first = rows_.A.outerIndexPtr()[k], count = rows_.A.outerIndexPtr()[k + 1] - first;
  const double* in = rows_.A.valuePtr() + first;
  const int* row = rows_.A.innerIndexPtr() + first;
  double* out = end - count;
  for (int i = 0; i < count;) {
    if (row[i] < rows_.equal) {
      ++i;
      continue;
    }
    const int cone = rows_.cone_at[row[i] - rows_.equal];
    scaling_->apply_inverse(cone, row[i] - rows_.equal, in + i, out + i);
    i += rows_.cones[cone];
  }
}

VectorXd ConeKkt::times(const VectorXd& v) const {
  const int n = rows_.unknowns(), m = rows_.in_cones();
  const VectorXd x = v.head(n);
  VectorXd z = v.tail(rows_.count()), Ax = rows_.A * x;
  const VectorXd scaled = z.tail(m);
  z.tail(m) = scaling_->apply_inverse(scaled);
  Ax.tail(m) = scaling_->apply_inverse(Ax.tail(m)) - scaled;
  VectorXd out(v.size());
  out << rows_.P * x + rows_.At * z, Ax;
  return out;
}

}  // namespace clench
