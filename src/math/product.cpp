#include "clench/math/product.h"

namespace clench {

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd out(a.rows(), b.cols());
  in_column_parts(b.cols(), a.rows(), a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleCols(first, count).noalias() = a * b.middleCols(first, count);
  });
  return out;
}

}  // namespace clench
