// Systems of equations between small groups of unknowns, such as the coordinates of bodies of which
// few touch each other.
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace clench {

/// LU of a matrix of dense blocks most of which are 0. Groups are eliminated in an order of least
/// degree, so that few blocks fill; pivots are chosen within the diagonal blocks alone, which suits
/// matrices whose symmetric part is positive definite, or nearly so.
/// source  George & Liu (1989), The evolution of the minimum degree ordering algorithm
class BlockLu {
 public:
  /// Lays out the blocks for matrices of one pattern.
  /// sizes  unknowns of each group, > 0
  /// pairs  groups (i, j), i != j, with blocks of their own: (i, j) and (j, i); may repeat
  void analyze(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& pairs);
  void set_zero();
  /// Where a block is among values(), by columns, with size(i) rows.   i, j  one of the pairs, or i
  /// == j
  int place(int i, int j) const;
  /// Of the matrix, until factor() replaces it by its factors.
  double* values() { return values_.data(); }
  /// returns  false: a pivot is 0 or not finite
  bool factor();
  /// x = m^-1 x, after a factor() that returned true.   x  all unknowns, group by group
  void solve(Eigen::VectorXd& x) const;

 private:
  // A group that is eliminated later, and where its two blocks with an earlier one are.
  struct Later {
    int group = 0;
    int upper = 0, lower = 0;  // (earlier, later) and (later, earlier)
  };
  void find_order(const std::vector<std::pair<int, int>>& pairs);
  void lay_out();
  template <int Size>
  bool eliminate(int group);

  std::vector<int> sizes_, first_;  // first_: unknown of each group
  std::vector<int> order_, position_;
  std::vector<std::vector<int>> neighbours_;  // while the order is found; then those that are later
  std::vector<std::vector<Later>> later_;     // by group, as they are eliminated
  std::vector<int> diagonal_;                 // by group: where its block is
  std::vector<int> targets_,
      first_target_;  // of each elimination: blocks that it changes, by group
  std::vector<double> values_;
  std::vector<int> exchanged_;  // rows of one diagonal block
  bool all_six_ = false;
};

}  // namespace clench
