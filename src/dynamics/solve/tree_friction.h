// A friction problem stored by the trees of bodies that its rows act on: products with J M^-1 J^T
// without forming that matrix.
#pragma once
#include <array>

#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

/// The problem of FrictionProblem with W = Y^T Y + compliance, where Y = L^-1 J^T: each block of
/// rows acts on at most two trees, and has a block of columns of Y for each. Time and memory of
/// products grow with the number of rows, not with its square. z = Y r is the motion of the trees,
/// in coordinates in which every mass is 1.
struct TreeFriction {
  struct Side {
    int tree = -1;  ///< -1: none
    int at = 0;     ///< index of its first number in `columns`
  };
  struct Block : FrictionProblem::Block {
    std::array<Side, 2> sides = {};
    double compliance = 0;  ///< of a bounded row
    double d = 0;           ///< mean of the diagonal of W over its rows
    double weight = 0;      ///< of damping: mean of d over the contacts of a pair of bodies; else d
    bool moves = true;      ///< false: no impulse changes its velocity
  };
  std::vector<Block> blocks;    ///< they cover the rows in order
  std::vector<int> first;       ///< by tree: its first coordinate; last: number of coordinates
  std::vector<double> columns;  ///< of each side: coordinates x rows, by columns
  Eigen::VectorXd q;            ///< velocities of the rows without impulses, as in FrictionProblem

  /// Removes trees and blocks. Then add all trees, and after them the blocks with their sides.
  void clear();
  void add_tree(int size) { first.push_back(first.back() + size); }
  /// Adds a side to the last block.   Y  columns of the block's rows
  void add_side(int tree, const Eigen::Ref<const Eigen::MatrixXd>& Y);
  /// Computes d, weight and moves of all blocks; to be called after the last block.
  void finish();

  int rows() const { return static_cast<int>(q.size()); }
  int trees() const { return static_cast<int>(first.size()) - 1; }
  int size(int tree) const { return first[tree + 1] - first[tree]; }
  auto side(const Block& block, const Side& side) const {
    return Eigen::Map<const Eigen::MatrixXd>(columns.data() + side.at, size(side.tree),
                                             block.size());
  }
  /// z = Y r
  void move(const Eigen::VectorXd& r, Eigen::VectorXd& z) const;
  /// Adds Y r of one block to z.
  void add_motion(const Block& block, const double* r, Eigen::VectorXd& z) const;
  /// Adds Y^T z of one block to its rows.
  void add_velocity(const Block& block, const Eigen::VectorXd& z, double* u) const;
  /// u = q + compliance r + Y^T z
  void velocities(const Eigen::VectorXd& r, const Eigen::VectorXd& z, Eigen::VectorXd& u) const;
  /// The same problem with its matrix W.
  FrictionProblem assembled() const;
};

}  // namespace clench
