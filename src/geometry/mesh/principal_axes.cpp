#include "clench/geometry/mesh/principal_axes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace clench {

using Eigen::Matrix3d;

// rotates rows and columns p and q so that their common entry vanishes
static void rotate(Matrix3d& m, Matrix3d& vectors, int p, int q) {
  if (m(p, q) == 0) return;
  const double theta = (m(q, q) - m(p, p)) / (2 * m(p, q));
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const int r = 3 - p - q;
  const double shift = t * m(p, q), rp = m(r, p), rq = m(r, q);
  m(p, p) -= shift, m(q, q) += shift, m(p, q) = m(q, p) = 0;
  m(r, p) = m(p, r) = c * rp - s * rq;
  m(r, q) = m(q, r) = s * rp + c * rq;
  const Eigen::Vector3d vp = vectors.col(p), vq = vectors.col(q);
  vectors.col(p) = c * vp - s * vq;
  vectors.col(q) = s * vp + c * vq;
}

Matrix3d principal_axes(const Matrix3d& symmetric) {
  const double scale = symmetric.cwiseAbs().maxCoeff();
  if (!(scale > 0) || !std::isfinite(scale)) return Matrix3d::Identity();
  Matrix3d m = symmetric / scale, vectors = Matrix3d::Identity();
  // it converges quadratically: six sweeps are more than enough
  for (int sweep = 0; sweep < 6; ++sweep) {
    if (std::abs(m(0, 1)) + std::abs(m(0, 2)) + std::abs(m(1, 2)) < 1e-15) break;
    rotate(m, vectors, 0, 1), rotate(m, vectors, 0, 2), rotate(m, vectors, 1, 2);
  }
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return m(i, i) < m(j, j); });
  Matrix3d out;
  out << vectors.col(order[0]), vectors.col(order[1]),
      vectors.col(order[0]).cross(vectors.col(order[1]));
  return out;
}

}  // namespace clench
