#include "clench/dynamics/solve/contact_block.h"

#include <algorithm>
#include <cmath>

namespace clench {
namespace {

// eigenvalues onto the diagonal of A, eigenvectors into the columns of V, by Jacobi rotations
void diagonalize(int n, double A[3][3], double* V) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) V[n * j + i] = i == j;
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0, on = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) (i == j ? on : off) += A[i][j] * A[i][j];
    if (off <= 1e-34 * on) return;
    for (int p = 0; p < n; ++p)
      for (int q = p + 1; q < n; ++q) {
        if (A[p][q] == 0) continue;
        const double theta = (A[q][q] - A[p][p]) / (2 * A[p][q]);
        const double t = std::copysign(1 / (std::abs(theta) + std::hypot(theta, 1.0)), theta);
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < n; ++k) {
          const double x = A[k][p], y = A[k][q];
          A[k][p] = c * x - s * y, A[k][q] = s * x + c * y;
        }
        for (int k = 0; k < n; ++k) {
          const double x = A[p][k], y = A[q][k];
          A[p][k] = c * x - s * y, A[q][k] = s * x + c * y;
        }
        for (int k = 0; k < n; ++k) {
          const double x = V[n * p + k], y = V[n * q + k];
          V[n * p + k] = c * x - s * y, V[n * q + k] = s * x + c * y;
        }
      }
  }
}

}  // namespace

void ContactBlock::set(double mu, int tangents, const double* W, int stride, double added) {
  mu_ = mu, tangents_ = mu > 0 ? tangents : 0;
  W_nn_ = W[0] + added;
  double A[3][3];
  for (int i = 0; i < tangents_; ++i) W_tn_[i] = W[1 + i];
  for (int i = 0; i < tangents_; ++i)
    for (int j = 0; j < tangents_; ++j)
      A[i][j] = W[stride * (1 + i) + 1 + j] + (i == j ? added : 0) - W_tn_[i] * W_tn_[j] / W_nn_;
  diagonalize(tangents_, A, V_);
  for (int k = 0; k < tangents_; ++k) {
    a_[k] = std::max(A[k][k], added), w_[k] = 0;
    for (int i = 0; i < tangents_; ++i) w_[k] += V_[tangents_ * k + i] * W_tn_[i];
  }
  tangents_ = tangents;
}

// |r_t| - mu r_n
double ContactBlock::excess(double lambda, double normal, const double* c, double* y,
                            double& r_n) const {
  double square = 0;
  r_n = normal;
  for (int k = 0; k < tangents_; ++k) {
    y[k] = c[k] / (a_[k] + lambda);
    square += y[k] * y[k];
    r_n -= w_[k] * y[k] / W_nn_;
  }
  return std::sqrt(square) - mu_ * r_n;
}

void ContactBlock::solve(const double* q, double* r) const {
  std::fill(r, r + 1 + tangents_, 0.0);
  if (!(q[0] < 0)) return;
  const double normal = -q[0] / W_nn_;
  r[0] = normal;
  if (tangents_ == 0 || mu_ == 0) return;
  double c[3] = {}, y[3] = {};
  for (int k = 0; k < tangents_; ++k) {
    c[k] = 0;
    for (int i = 0; i < tangents_; ++i)
      c[k] -= V_[tangents_ * k + i] * (q[1 + i] + W_tn_[i] * normal);
  }
  double low = 0, below = excess(0, normal, c, y, r[0]);
  if (below > 0) {
    // a bracket of the root, then the Illinois variant of false position
    double high = *std::max_element(a_, a_ + tangents_), above = 0;
    for (int i = 0; i < 1000; ++i, high *= 4) {
      above = excess(high, normal, c, y, r[0]);
      if (above <= 0) break;
      low = high, below = above;
    }
    for (int i = 0; i < 60 && high - low > 1e-15 * high; ++i) {
      double middle = (low * above - high * below) / (above - below);
      if (i > 20 || !(middle > low && middle < high)) middle = low + (high - low) / 2;
      const double value = excess(middle, normal, c, y, r[0]);
      if (std::abs(value) <= 1e-16 * mu_ * r[0]) break;
      if (value > 0) {
        low = middle, below = value, above /= 2;
      } else {
        high = middle, above = value, below /= 2;
      }
    }
  }
  double square = 0;
  for (int i = 0; i < tangents_; ++i) {
    for (int k = 0; k < tangents_; ++k) r[1 + i] += V_[tangents_ * k + i] * y[k];
    square += r[1 + i] * r[1 + i];
  }
  r[0] = std::max(r[0], 0.0);
  // rounding cannot move it out of the cone
  const double length = std::sqrt(square);
  if (length > mu_ * r[0])
    for (int i = 1; i <= tangents_; ++i) r[i] *= mu_ * r[0] / length;
}

}  // namespace clench
