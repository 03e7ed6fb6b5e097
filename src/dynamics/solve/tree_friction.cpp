#include "clench/dynamics/solve/tree_friction.h"

#include <algorithm>

namespace clench {

void TreeFriction::clear() {
  blocks.clear();
  columns.clear();
  first.assign(1, 0);
}

void TreeFriction::add_side(int tree, const Eigen::Ref<const Eigen::MatrixXd>& Y) {
  Block& block = blocks.back();
  Side& side = block.sides[block.sides[0].tree < 0 ? 0 : 1];
  side = {.tree = tree, .at = static_cast<int>(columns.size())};
  columns.resize(columns.size() + static_cast<size_t>(Y.size()));
  Eigen::Map<Eigen::MatrixXd>(columns.data() + side.at, Y.rows(), Y.cols()) = Y;
}

void TreeFriction::finish() {
  double largest = 0;
  for (Block& block : blocks) {
    block.d = block.compliance;
    for (const Side& s : block.sides)
      if (s.tree >= 0) block.d += side(block, s).squaredNorm() / block.size();
    largest = std::max(largest, block.d);
  }
  for (Block& block : blocks) block.moves = block.d > 1e-30 * largest && block.d > 1e-200;
  // all contacts of one pair of bodies have the same weight
  for (size_t begin = 0, end; begin < blocks.size(); begin = end) {
    double sum = 0;
    for (end = begin;
         end < blocks.size() &&
         (end == begin || (blocks[begin].pair >= 0 && blocks[end].pair == blocks[begin].pair));
         ++end)
      sum += blocks[end].d;
    for (size_t i = begin; i < end; ++i) blocks[i].weight = sum / static_cast<double>(end - begin);
  }
}

namespace {

// For the most frequent sizes, six coordinates and three rows: loops of known length.
template <int Coordinates, int Rows>
void add_product(const double* Y, const double* r, double* z) {
  for (int k = 0; k < Rows; ++k)
    for (int i = 0; i < Coordinates; ++i) z[i] += Y[Coordinates * k + i] * r[k];
}

template <int Coordinates, int Rows>
void add_transposed(const double* Y, const double* z, double* u) {
  for (int k = 0; k < Rows; ++k) {
    double sum = 0;
    for (int i = 0; i < Coordinates; ++i) sum += Y[Coordinates * k + i] * z[i];
    u[k] += sum;
  }
}

}  // namespace

void TreeFriction::add_motion(const Block& block, const double* r, Eigen::VectorXd& z) const {
  for (const Side& s : block.sides) {
    if (s.tree < 0) continue;
    const double* Y = columns.data() + s.at;
    double* to = z.data() + first[s.tree];
    const int n = size(s.tree);
    if (n == 6 && block.size() == 3)
      add_product<6, 3>(Y, r, to);
    else
      for (int k = 0; k < block.size(); ++k)
        for (int i = 0; i < n; ++i) to[i] += Y[n * k + i] * r[k];
  }
}

void TreeFriction::add_velocity(const Block& block, const Eigen::VectorXd& z, double* u) const {
  for (const Side& s : block.sides) {
    if (s.tree < 0) continue;
    const double* Y = columns.data() + s.at;
    const double* from = z.data() + first[s.tree];
    const int n = size(s.tree);
    if (n == 6 && block.size() == 3) {
      add_transposed<6, 3>(Y, from, u);
      continue;
    }
    for (int k = 0; k < block.size(); ++k) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += Y[n * k + i] * from[i];
      u[k] += sum;
    }
  }
}

void TreeFriction::move(const Eigen::VectorXd& r, Eigen::VectorXd& z) const {
  z.setZero(first.back());
  for (const Block& block : blocks) add_motion(block, &r[block.row], z);
}

void TreeFriction::velocities(const Eigen::VectorXd& r, const Eigen::VectorXd& z,
                              Eigen::VectorXd& u) const {
  u = q;
  for (const Block& block : blocks) {
    if (block.compliance != 0) u[block.row] += block.compliance * r[block.row];
    add_velocity(block, z, &u[block.row]);
  }
}

FrictionProblem TreeFriction::assembled() const {
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(first.back(), rows());
  FrictionProblem out;
  for (const Block& block : blocks) {
    for (const Side& s : block.sides)
      if (s.tree >= 0)
        Y.block(first[s.tree], block.row, size(s.tree), block.size()) += side(block, s);
    out.blocks.push_back(block);
  }
  out.W = Y.transpose() * Y;
  for (const Block& block : blocks) out.W(block.row, block.row) += block.compliance;
  out.q = q;
  return out;
}

}  // namespace clench
