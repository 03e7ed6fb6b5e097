#include "clench/dynamics/solve/dense_system.h"

#include <cmath>
#include <utility>

namespace clench {
namespace {

// y[i] -= sum over k of factors[k] * columns[k][i]: four columns at a time
void subtract(int rows, int count, const double* column, long stride, const double* factors, long factor_stride, double* y) {
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    const double *a = column + k * stride, *b = a + stride, *c = b + stride, *d = c + stride;
    const double fa = factors[k * factor_stride], fb = factors[(k + 1) * factor_stride],
                 fc = factors[(k + 2) * factor_stride], fd = factors[(k + 3) * factor_stride];
    for (int i = 0; i < rows; ++i) y[i] -= fa * a[i] + fb * b[i] + (fc * c[i] + fd * d[i]);
  }
  for (; k < count; ++k) {
    const double* a = column + k * stride;
    const double f = factors[k * factor_stride];
    for (int i = 0; i < rows; ++i) y[i] -= f * a[i];
  }
}

}  // namespace

Eigen::MatrixXd& DenseSystem::matrix(int n) {
  m_.resize(n, n);
  return m_;
}

bool DenseSystem::factor(bool symmetric) {
  symmetric_ = symmetric;
  inverse_.resize(m_.rows());
  return symmetric ? factor_symmetric() : factor_general();
}

bool DenseSystem::factor_symmetric() {
  const int n = static_cast<int>(m_.rows());
  double* m = m_.data();
  for (int j = 0; j < n; ++j) {
    double* column = m + static_cast<long>(n) * j;
    // what the columns before have of this one: row j holds their factors
    subtract(n - j, j, m + j, n, m + j, n, column + j);
    if (!(column[j] > 0 && std::isfinite(column[j]))) return false;
    const double root = std::sqrt(column[j]);
    inverse_[j] = 1 / root;
    column[j] = root;
    for (int i = j + 1; i < n; ++i) column[i] *= inverse_[j];
  }
  return true;
}

bool DenseSystem::factor_general() {
  const int n = static_cast<int>(m_.rows());
  double* m = m_.data();
  pivots_.resize(n);
  for (int j = 0; j < n; ++j) {
    double* column = m + static_cast<long>(n) * j;
    for (int k = 0; k < j; ++k) std::swap(column[k], column[pivots_[k]]);
    for (int k = 0; k < j; ++k) {
      const double* before = m + static_cast<long>(n) * k;
      const double f = column[k];
      for (int i = k + 1; i < j; ++i) column[i] -= f * before[i];
    }
    subtract(n - j, j, m + j, n, column, 1, column + j);
    int pivot = j;
    for (int i = j + 1; i < n; ++i)
      if (std::abs(column[i]) > std::abs(column[pivot])) pivot = i;
    pivots_[j] = pivot;
    if (!(std::abs(column[pivot]) > 0 && std::isfinite(column[pivot]))) return false;
    if (pivot != j)
      for (int k = 0; k <= j; ++k) std::swap(m[static_cast<long>(n) * k + j], m[static_cast<long>(n) * k + pivot]);
    inverse_[j] = 1 / column[j];
    for (int i = j + 1; i < n; ++i) column[i] *= inverse_[j];
  }
  return true;
}

void DenseSystem::solve(Eigen::VectorXd& right) const {
  const int n = static_cast<int>(m_.rows());
  const double* m = m_.data();
  double* x = right.data();
  if (!symmetric_)
    for (int k = 0; k < n; ++k) std::swap(x[k], x[pivots_[k]]);
  for (int k = 0; k < n; ++k) {
    if (symmetric_) x[k] *= inverse_[k];
    const double* column = m + static_cast<long>(n) * k;
    const double f = x[k];
    for (int i = k + 1; i < n; ++i) x[i] -= f * column[i];
  }
  for (int k = n - 1; k >= 0; --k) {
    const double* column = m + static_cast<long>(n) * k;
    if (symmetric_) {
      double sum = x[k];
      for (int i = k + 1; i < n; ++i) sum -= column[i] * x[i];
      x[k] = sum * inverse_[k];
    } else {
      x[k] *= inverse_[k];
      const double f = x[k];
      for (int i = 0; i < k; ++i) x[i] -= f * column[i];
    }
  }
}

}  // namespace clench
