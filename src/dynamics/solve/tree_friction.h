// A friction problem by the trees of bodies that its rows act on: products with J M^-1 J^T, without
// the matrix.
#pragma once
#include <array>

#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

/// The problem of FrictionProblem with W = Y^T Y + compliance, where Y = L^-1 J^T has a block of
/// columns for each tree that a block of rows acts on: two at most. Time and memory of all products
/// grow with the rows, not with their square. Its trees have one motion each, z = Y r: coordinates
/// in which every mass is 1.
struct TreeFriction {
  struct Side {
    int tree = -1;  ///< -1: none
    int at = 0;     ///< of its first number in `columns`
  };
  struct Block : FrictionProblem::Block {
    std::array<Side, 2> sides = {};
    double compliance = 0;  ///< of a bounded row
    double d = 0;           ///< mean of the diagonal of W over its rows
    double weight = 0;      ///< of contacts of one pair the mean of d; else d
    bool moves = true;      ///< false: no impulse changes its velocity
  };
  std::vector<Block> blocks;    ///< they cover the rows in order
  std::vector<int> first;       ///< by tree: its first coordinate; then their number
  std::vector<double> columns;  ///< of each side: coordinates x rows
  Eigen::VectorXd q;

  /// Forgets all; trees come first, then blocks with their sides.
  void clear();
  void add_tree(int size) { first.push_back(first.back() + size); }
  /// A side of the last block.   Y  its rows' columns
  void add_side(int tree, const Eigen::Ref<const Eigen::MatrixXd>& Y);
  /// Finds d, weights and what moves; after the last block.
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
  /// The same problem with its matrix.
  FrictionProblem assembled() const;
};

}  // namespace clench
