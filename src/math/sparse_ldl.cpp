#include "clench/math/sparse_ldl.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

namespace clench {

struct SparseLdl::Parts {
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver;
};

SparseLdl::SparseLdl(const Matrix& lower) : parts_(std::make_unique<Parts>()) {
  parts_->solver.analyzePattern(lower);
}

SparseLdl::SparseLdl(SparseLdl&&) noexcept = default;
SparseLdl::~SparseLdl() = default;

bool SparseLdl::factor(const Matrix& lower) {
  parts_->solver.factorize(lower);
  return parts_->solver.info() == Eigen::Success && parts_->solver.vectorD().allFinite();
}

Eigen::VectorXd SparseLdl::solve(const Eigen::VectorXd& right) const {
  return parts_->solver.solve(right);
}

}  // namespace clench
