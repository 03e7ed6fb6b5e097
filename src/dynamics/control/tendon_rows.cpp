#include "clench/dynamics/control/tendon_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clench {

static constexpr double no_limit = std::numeric_limits<double>::infinity();

namespace {

class TendonRows {
 public:
  TendonRows(const World& world, int tree, double h, std::vector<CoordinateRow>& out)
      : world_(world), tree_(tree), h_(h), out_(out) {}

  /// index  of the tendon among all; length and velocity of it
  void add(const JointTendonSpec& tendon, int index,
           const std::vector<std::pair<int, double>>& arms, double length, double velocity) {
    arms_ = &arms;
    const double step = std::max(world_.dynamic_settings().step, h_);
    if (tendon.range) {
      const auto [low, high] = *tendon.range;
      if (limit_is_near(length - low, velocity, step))
        push(RowKind::tendon_low, index, limit_target(low - length, step), 0, no_limit);
      if (limit_is_near(high - length, velocity, step))
        push(RowKind::tendon_high, index, -limit_target(length - high, step), -no_limit, 0);
    }
    const double rest = std::clamp(length, tendon.slack[0], tendon.slack[1]);
    const double stiffness = length == rest ? 0 : tendon.stiffness;
    const double gain = h_ * (tendon.damping + h_ * stiffness);
    if (gain > 0)
      push(RowKind::tendon_spring, index, h_ * stiffness * (rest - length) / gain, -no_limit,
           no_limit, 1 / gain);
    if (tendon.friction > 0)
      push(RowKind::tendon_friction, index, 0, -tendon.friction * h_, tendon.friction * h_);
  }

 private:
  void push(RowKind kind, int index, double target, double low, double high,
            double compliance = 0) {
    CoordinateRow row{kind, index, tree_, arms_->front().first, target, low, high, compliance};
    row.arms = *arms_;
    out_.push_back(std::move(row));
  }

  const World& world_;
  int tree_;
  double h_;
  std::vector<CoordinateRow>& out_;
  const std::vector<std::pair<int, double>>* arms_ = nullptr;
};

/// Index of a DOF among the coordinates of the tree; -1 if it is not one of them.
int coordinate_of(const Articulation& tree, Id<Robot> robot, int dof) {
  for (size_t i = 0; i < tree.coordinates.size(); ++i) {
    const Coordinate& c = tree.coordinates[i];
    if (c.robot == robot && c.joint < 0 && c.dof == dof)
      return tree.root_size() + static_cast<int>(i);
  }
  return -1;
}

}  // namespace

void add_tendon_rows(const World& world, const Articulation& tree, int number, double h,
                     const DynamicState& state, std::vector<CoordinateRow>& out) {
  TendonRows rows(world, number, h, out);
  int index = -1;
  for (const auto id : world.robots()) {
    const Robot& robot = world.robot(id);
    const bool here = std::ranges::find(tree.robots, id) != tree.robots.end();
    for (const JointTendonSpec& tendon : robot.joint_tendons) {
      ++index;
      if (!here) continue;
      std::vector<std::pair<int, double>> arms;
      double length = 0, velocity = 0;
      for (const auto& [dof, arm] : tendon.arms) {
        length += arm * world.dofs(id)[dof];
        velocity += arm * state.dof_velocities[robot.first_dof + static_cast<size_t>(dof)];
        if (const int c = coordinate_of(tree, id, dof); c >= 0) arms.emplace_back(c, arm);
      }
      if (!arms.empty()) rows.add(tendon, index, arms, length, velocity);
    }
  }
}

void add_free_friction_rows(const World& world, const Articulation& tree, int number, double h,
                            std::vector<CoordinateRow>& out) {
  if (!tree.floating) return;
  const double most = h * world.body(tree.root).free_friction;
  if (!(most > 0)) return;
  Eigen::Matrix<double, 6, 6> J = free_motion(world, tree);
  J.bottomRows<3>() = world.pose(tree.root).matrix().transpose() * J.bottomRows<3>();
  for (int k = 0; k < 6; ++k) {
    CoordinateRow row{RowKind::free_friction,
                      6 * static_cast<int>(tree.root.index) + k,
                      number,
                      k,
                      0,
                      -most,
                      most,
                      0};
    for (int c = 0; c < 6; ++c)
      if (J(k, c) != 0) row.arms.emplace_back(c, J(k, c));
    out.push_back(std::move(row));
  }
}

}  // namespace clench
