#include "clench/math/cone_builder.h"

namespace clench {

using Eigen::MatrixXd, Eigen::VectorXd;

int ConeBuilder::unknowns(int count) {
  unknowns_ += count;
  return unknowns_ - count;
}

void ConeBuilder::cost(int column, double c) { costs_.push_back({0, column, c}); }

void ConeBuilder::square(int column, double weight) { squares_.push_back({0, column, weight}); }

ConeRange ConeBuilder::add(Part& part, const std::vector<ConeBlock>& blocks, const VectorXd& right,
                           double sign) {
  const int start = static_cast<int>(part.right.size());
  for (const ConeBlock& block : blocks)
    for (int k = 0; k < block.left.cols(); ++k)
      for (int i = 0; i < block.left.rows(); ++i)
        if (block.left(i, k) != 0)
          part.entries.push_back({start + i, block.column + k, sign * block.left(i, k)});
  part.right.insert(part.right.end(), right.begin(), right.end());
  return {start, static_cast<int>(right.size())};
}

ConeRange ConeBuilder::equal(const std::vector<ConeBlock>& blocks, const VectorXd& right) {
  return add(equal_, blocks, right, 1);
}

ConeRange ConeBuilder::at_most(const std::vector<ConeBlock>& blocks, const VectorXd& right) {
  return add(at_most_, blocks, right, 1);
}

ConeRange ConeBuilder::cone(const std::vector<ConeBlock>& blocks) {
  const auto rows = blocks.front().left.rows();
  sizes_.push_back(static_cast<int>(rows));
  return add(cones_, blocks, VectorXd::Zero(rows), -1);
}

MatrixXd ConeBuilder::dense(const Part& part, int more_rows) const {
  MatrixXd m = MatrixXd::Zero(static_cast<int>(part.right.size()) + more_rows, unknowns_);
  for (const Entry& e : part.entries) m(e.row, e.column) += e.value;
  return m;
}

ConeProgram ConeBuilder::program() const {
  ConeProgram p;
  p.c = VectorXd::Zero(unknowns_);
  for (const Entry& e : costs_) p.c[e.column] += e.value;
  if (!squares_.empty()) p.P = MatrixXd::Zero(unknowns_, unknowns_);
  for (const Entry& e : squares_) p.P(e.column, e.column) += e.value;
  p.A = dense(equal_, 0);
  p.b = Eigen::Map<const VectorXd>(equal_.right.data(), p.A.rows());
  const int rows = cones_start(), in_cones = static_cast<int>(cones_.right.size());
  p.G = dense(at_most_, in_cones);
  for (const Entry& e : cones_.entries) p.G(rows + e.row, e.column) += e.value;
  p.h = VectorXd::Zero(rows + in_cones);
  p.h.head(rows) = Eigen::Map<const VectorXd>(at_most_.right.data(), rows);
  p.nonnegative = rows;
  p.cones = sizes_;
  return p;
}

}  // namespace clench
