// Sparse linear systems whose unknowns form small groups, such as the coordinates of bodies each of
// which touches few others.
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace clench {

/// LU factors of a matrix of dense blocks, most of which are 0. Groups are eliminated in minimum
/// degree order, which keeps fill-in low; pivots are chosen within the diagonal blocks alone, which
/// suits matrices whose symmetric part is positive definite, or nearly so.
/// source  George & Liu (1989), The evolution of the minimum degree ordering algorithm
class BlockLu {
 public:
  /// Lays out the blocks for matrices of one pattern.
  /// sizes  unknowns of each group, > 0
  /// pairs  groups (i, j), i != j, whose blocks (i, j) and (j, i) may be nonzero; may repeat
  void analyze(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& pairs);
  /// Sets all blocks to 0.
  void set_zero();
  /// Index in values() of block (i, j), stored by columns.   i, j  one of the pairs, or i == j
  int place(int i, int j) const;
  /// Values of the blocks: of the matrix, and after factor() of its factors.
  double* values() { return values_.data(); }
  /// Replaces the matrix by its factors.   returns  false: a pivot is 0 or not finite
  bool factor();
  /// Replaces x by the solution of (matrix) y = x, after a factor() that returned true.
  /// x  all unknowns, group by group
  void solve(Eigen::VectorXd& x) const;

 private:
  // A neighbor of a group that is eliminated later, and the positions of the pair's two blocks.
  struct Later {
    int group = 0;
    int upper = 0, lower = 0;  // (earlier, later) and (later, earlier)
  };
  void find_order(const std::vector<std::pair<int, int>>& pairs);
  void lay_out();
  template <int Size>
  bool eliminate(int group);

  std::vector<int> sizes_, first_;  // first_: first unknown of each group
  // elimination order; position_: by group, its index in order_
  std::vector<int> order_, position_;
  std::vector<std::vector<int>> neighbors_;  // of each group, among those eliminated later
  std::vector<std::vector<Later>> later_;    // by group, in elimination order
  std::vector<int> diagonal_;                // by group: position of its block
  std::vector<int> targets_, first_target_;  // by group: blocks that its elimination changes
  std::vector<double> values_;
  std::vector<int> exchanged_;  // rows of one diagonal block
  bool all_six_ = false;
};

}  // namespace clench
