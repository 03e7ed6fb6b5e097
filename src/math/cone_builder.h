// Assembles a cone program block by block.
#pragma once
#include "clench/math/cone_program.h"

namespace clench {

/// A block of coefficients: `left` times the unknowns from `column` on.
struct ConeBlock {
  int column = 0;
  Eigen::MatrixXd left;
};

/// Position of a constraint's multipliers in y or z of a solution.
struct ConeRange {
  int start = 0, count = 0;
};

class ConeBuilder {
 public:
  /// Adds unknowns.
  /// returns  the column of the first one
  int unknowns(int count);
  int count() const { return unknowns_; }
  /// Adds to the objective: c.x, 1/2 weight x^2.
  void cost(int column, double c);
  void square(int column, double weight);
  /// sum of blocks = right; multipliers in y
  ConeRange equal(const std::vector<ConeBlock>& blocks, const Eigen::VectorXd& right);
  /// sum of blocks <= right; multipliers in z
  ConeRange at_most(const std::vector<ConeBlock>& blocks, const Eigen::VectorXd& right);
  /// sum of blocks, (t, u), in the cone |u| <= t; multipliers in z, counted from cones_start()
  ConeRange cone(const std::vector<ConeBlock>& blocks);
  /// first row of the cones in z; valid after the last at_most()
  int cones_start() const { return static_cast<int>(at_most_.right.size()); }
  ConeProgram program() const;

 private:
  struct Entry {
    int row, column;
    double value;
  };
  struct Part {
    std::vector<Entry> entries;
    std::vector<double> right;
  };
  static ConeRange add(Part& part, const std::vector<ConeBlock>& blocks,
                       const Eigen::VectorXd& right, double sign);
  Eigen::MatrixXd dense(const Part& part, int more_rows) const;

  int unknowns_ = 0;
  std::vector<Entry> costs_, squares_;
  Part equal_, at_most_, cones_;
  std::vector<int> sizes_;
};

}  // namespace clench
