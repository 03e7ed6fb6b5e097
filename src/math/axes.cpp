#include "clench/math/axes.h"

namespace clench {

std::optional<Eigen::Quaterniond> rotation_from_axes(int i, const Eigen::Vector3d& a, int j,
                                                     const Eigen::Vector3d& b) {
  const Eigen::Vector3d first = a.stableNormalized();
  const Eigen::Vector3d third = first.cross(b.stableNormalized());
  // normalizing keeps zero as zero, and makes vectors that are not finite NaN
  if (!(third.norm() > 1e-9)) return {};
  const bool in_turn = (j - i + 3) % 3 == 1;  // as x, y; y, z; z, x
  const Eigen::Vector3d n = third.normalized();
  Eigen::Matrix3d R;
  R.col(i) = first;
  R.col(j) = n.cross(first);
  R.col(3 - i - j) = in_turn ? n : Eigen::Vector3d(-n);
  return Eigen::Quaterniond(R).normalized();
}

}  // namespace clench
