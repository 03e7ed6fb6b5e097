#include "clench/dynamics/control/motors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/model/dof.h"
#include "clench/model/effort_range.h"

namespace clench {

static constexpr double no_bound = std::numeric_limits<double>::infinity();
static constexpr double natural_frequency = 60;  // of motors without gains [rad/s]
// a limit becomes a row when its distance is at most this many steps at the present speed, or at
// most this distance
static constexpr double steps_ahead = 8, always_near = 0.05;
// this fraction of a joint's excess over its limit is corrected per step, but no faster than this
// [rad/s or m/s]
static constexpr double returned_part = 0.2, returned_at_most = 1;

bool limit_is_near(double gap, double velocity, double step) {
  return gap < steps_ahead * std::abs(velocity) * step + always_near;
}

double limit_target(double beyond, double step) {
  return beyond <= 0 ? beyond / step : std::min(returned_part * beyond / step, returned_at_most);
}

Gains gains_of(const World& world, Id<Robot> id, int dof, double inertia) {
  const RobotDynamics& settings = world.dynamic_settings().robot(id);
  if (dof < static_cast<int>(settings.gains.size()) && settings.gains[dof])
    return *settings.gains[dof];
  const DofSpec& spec = world.robot(id).dofs[dof];
  if (spec.kp > 0 || spec.kd > 0)
    return {spec.kp,
            spec.kd + 2 * spec.damping_ratio * std::sqrt(std::max(0.0, spec.kp) * inertia)};
  return {inertia * natural_frequency * natural_frequency, 2 * inertia * natural_frequency};
}

double tendon_stiffness(const World& world, Id<Robot> id, int joint) {
  const Robot& robot = world.robot(id);
  const int dof = robot.joints[joint].dof;
  double sum = 0;
  bool sprung = true;
  for (const Joint& other : robot.joints)
    if (other.dof == dof) sprung = sprung && other.spring > 0, sum += other.ratio * other.ratio;
  if (sprung) return robot.joints[joint].spring;
  // all equal, together as stiff as the motor
  const double kp = robot.dofs[dof].kp;
  return (kp > 0 ? kp : 1) / std::max(sum, 1e-12);
}

static bool is_compliant(const Robot& robot, const Coordinate& c) {
  return robot.dofs[c.dof].kind == DofKind::compliant;
}

void find_joint_forces(const World& world, const Articulation& tree, const TreeDynamics& dynamics,
                       double h, const DynamicState& state, JointForces& out) {
  out.efforts.setZero(tree.size());
  out.velocity_part.setZero(tree.size());
  out.added.setZero(tree.size());
  for (const ArticulationJoint& part : tree.joints) {
    const Robot& robot = world.robot(part.robot);
    const Joint& joint = robot.joints[part.joint];
    const double q = world.joints(part.robot)[part.joint], r = part.ratio;
    double stiffness = joint.spring, rest = joint.rest;
    if (robot.dofs[joint.dof].kind == DofKind::compliant) {
      const size_t dof = robot.first_dof + static_cast<size_t>(joint.dof);
      stiffness = tendon_stiffness(world, part.robot, part.joint);
      rest = joint.ratio * (world.dofs(part.robot)[joint.dof] + h * state.dof_velocities[dof]);
    }
    out.efforts[part.coordinate] -= r * stiffness * (q - rest);
    out.velocity_part[part.coordinate] += r * r * h * (joint.viscous + h * stiffness);
    out.added[part.coordinate] += r * r * joint.armature;
  }
  out.added += out.velocity_part;
  out.root_added.resize(0, 0);
  out.root_velocity_part.resize(0, 0);
  if (const Body& root = world.body(tree.root);
      tree.floating && (root.free_damping != 0 || root.free_armature != 0)) {
    const Eigen::Matrix<double, 6, 6> J = free_motion(world, tree), JJ = J.transpose() * J;
    out.root_velocity_part = h * root.free_damping * JJ;
    out.root_added = out.root_velocity_part + root.free_armature * JJ;
  }
  out.weight.setZero(tree.size());
  if (tree.floating || tree.coordinates.empty()) return;
  const Eigen::VectorXd weight = dynamics.weight(world);
  for (int i = 0; i < static_cast<int>(tree.coordinates.size()); ++i) {
    const Coordinate& c = tree.coordinates[i];
    if (world.dynamic_settings().robot(c.robot).gravity_compensation &&
        world.robot(c.robot).dofs[c.dof].driven)
      out.weight[tree.root_size() + i] = weight[tree.root_size() + i];
  }
  out.efforts += out.weight;
}

static const DofDrive& drive_at(const World& world, const Coordinate& c) {
  return world.robot(c.robot).drives[static_cast<size_t>(c.dof)];
}

double feedforward_effort(const World& world, const Coordinate& c, const DynamicState& state) {
  if (c.joint >= 0) return 0;
  const DofControl& control = state.controls[c.dof_index];
  EffortRange range = effort_limits(world, c.robot, c.dof);
  // in this mode the effort of a servo depends only on its control
  if (control.mode == ControlMode::effort && drive_at(world, c).has_servo())
    range = effort_range(world, c.robot, c.dof);
  return std::clamp(control.effort, range.low, range.high);
}

// Excess of a servo's effort, without velocity feedback, over the efforts of all controls in its
// range. Gains set by a script replace the law of the servo, its control included.
// rounding  of the effort [N m or N]
static double beyond_control(const World& world, const Coordinate& c, double effort,
                             double rounding) {
  const DofDrive& drive = drive_at(world, c);
  if (!drive.has_servo()) return 0;
  const auto& set = world.dynamic_settings().robot(c.robot).gains;
  if (c.dof < static_cast<int>(set.size()) && set[c.dof]) return 0;
  const EffortRange range = drive.commanded(world.dofs(c.robot));
  const double excess = effort - std::clamp(effort, range.low, range.high);
  return std::abs(excess) <= rounding ? 0 : excess;
}

void pull_tendons(const World& world, Id<Robot> id, double h, DynamicState& state) {
  const Robot& robot = world.robot(id);
  // the next move may last a full step, however short this one was
  const double step = std::max(world.dynamic_settings().step, h);
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    const DofSpec& dof = robot.dofs[d];
    if (dof.kind != DofKind::compliant) continue;
    const size_t index = robot.first_dof + d;
    const DofControl& control = state.controls[index];
    const double x = world.dofs(id)[static_cast<int>(d)];
    double force = 0, stiffness = 0;
    for (size_t j = 0; j < robot.joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      if (joint.dof != static_cast<int>(d)) continue;
      const double k = tendon_stiffness(world, id, static_cast<int>(j));
      force += joint.ratio * k * (joint.ratio * x - world.joints(id)[static_cast<int>(j)]);
      stiffness += joint.ratio * joint.ratio * k;
    }
    if (!(stiffness > 0)) continue;
    double speed;
    if (control.mode == ControlMode::effort)  // the speed at which the springs reach the effort
      speed = (control.effort - force) / (stiffness * step);
    else if (control.mode == ControlMode::velocity)
      speed = control.velocity;
    else
      speed =
          ((control.trajectory ? control.trajectory->value(state.time + step) : control.target) -
           x) /
          step;
    const double fastest =
        dof.max_velocity > 0 ? dof.max_velocity : std::max(std::abs(dof.default_velocity), 1.0);
    speed = std::clamp(speed, -fastest, fastest);
    const EffortRange limits = effort_limits(world, id, static_cast<int>(d));
    speed = std::clamp(speed, std::min(0.0, (limits.low - force) / (stiffness * step)),
                       std::max(0.0, (limits.high - force) / (stiffness * step)));
    const auto [low, high] = range_around(robot, static_cast<int>(d), x);
    speed = std::clamp(speed, (low - x) / step, (high - x) / step);
    state.dof_velocities[index] = speed;
    state.dof_efforts[index] = force;
  }
}

namespace {

class RowMaker {
 public:
  RowMaker(const World& world, const Articulation& tree, int number, const Eigen::MatrixXd& M,
           double h, const DynamicState& state, std::vector<CoordinateRow>& out)
      : world_(world), tree_(tree), number_(number), M_(M), h_(h), state_(state), out_(out) {}

  void add(int i) {
    const Coordinate& c = tree_.coordinates[i];
    const Robot& robot = world_.robot(c.robot);
    const int column = tree_.root_size() + i;
    const bool alone = c.joint >= 0;
    const double q = alone ? world_.joints(c.robot)[c.joint] : world_.dofs(c.robot)[c.dof];
    const double v =
        alone ? state_.joint_velocities[c.joint_index] : state_.dof_velocities[c.dof_index];
    if (!alone) add_motor(c, column, q);
    if (alone && !is_compliant(robot, c)) add_lock(c, column);
    const std::array<double, 2> range =
        alone ? std::array{robot.joints[c.joint].min, robot.joints[c.joint].max}
              : robot.limits[c.dof];
    // joints without a DOF are numbered separately from DOFs
    const int index = alone ? -1 - static_cast<int>(c.joint_index) : static_cast<int>(c.dof_index);
    const double step = std::max(world_.dynamic_settings().step, h_);
    const bool endless = alone ? robot.joints[c.joint].endless : robot.endless[c.dof];
    if (!endless && limit_is_near(q - range[0], v, step))
      push(RowKind::low_limit, index, column, limit_target(range[0] - q, step), 0, no_bound);
    if (!endless && limit_is_near(range[1] - q, v, step))
      push(RowKind::high_limit, index, column, -limit_target(q - range[1], step), -no_bound, 0);
    double coulomb = 0;
    for (const ArticulationJoint& joint : tree_.joints)
      if (joint.coordinate == column)
        coulomb += std::abs(joint.ratio) * world_.robot(joint.robot).joints[joint.joint].coulomb;
    if (coulomb > 0) push(RowKind::dry_friction, index, column, 0, -coulomb * h_, coulomb * h_);
  }

 private:
  void push(RowKind kind, int index, int column, double target, double low, double high,
            double compliance = 0) {
    out_.push_back({kind, index, number_, column, target, low, high, compliance});
  }

  void add_motor(const Coordinate& c, int column, double q) {
    const DofControl& control = state_.controls[c.dof_index];
    if (control.mode == ControlMode::effort) return;
    Gains gains = gains_of(world_, c.robot, c.dof, M_(column, column));
    double target = q, velocity = control.velocity;
    if (control.mode == ControlMode::velocity) {
      gains.kp = 0;
      if (gains.kd <= 0) gains.kd = 2 * natural_frequency * M_(column, column);
    } else {
      target = control.trajectory ? control.trajectory->value(state_.time + h_) : control.target;
      if (control.trajectory) velocity = control.trajectory->velocity(state_.time + h_);
    }
    const EffortRange limits = effort_limits(world_, c.robot, c.dof);
    const double gain = h_ * (gains.kd + h_ * gains.kp);
    if (!(gain > 0)) return;
    // the sum stays within the limits
    const double given = feedforward_effort(world_, c, state_);
    double rest = control.effort - given;
    rest -=
        beyond_control(world_, c, gains.kp * (target - q) + gains.kd * velocity + control.effort,
                       1e-12 * (gains.kp * (std::abs(target) + std::abs(q)) +
                                std::abs(gains.kd * velocity) + std::abs(control.effort)));
    push(RowKind::motor, static_cast<int>(c.dof_index), column,
         h_ * (gains.kp * (target - q) + gains.kd * velocity + rest) / gain,
         (limits.low - given) * h_, (limits.high - given) * h_, 1 / gain);
  }

  // a joint that has left its breakaway DOF is locked by its worm gear, which nothing drives back
  // source  Townsend (2000), The BarrettHand grasper: programmably flexible part handling and
  //         assembly
  void add_lock(const Coordinate& c, int column) {
    push(RowKind::lock, -1 - static_cast<int>(c.joint_index), column, 0, -no_bound, no_bound);
  }

  const World& world_;
  const Articulation& tree_;
  int number_;
  const Eigen::MatrixXd& M_;
  double h_;
  const DynamicState& state_;
  std::vector<CoordinateRow>& out_;
};

}  // namespace

void add_coordinate_rows(const World& world, const Articulation& tree, int number,
                         const Eigen::MatrixXd& mass_matrix, double h, const DynamicState& state,
                         std::vector<CoordinateRow>& out) {
  RowMaker maker(world, tree, number, mass_matrix, h, state, out);
  for (int i = 0; i < static_cast<int>(tree.coordinates.size()); ++i) maker.add(i);
}

}  // namespace clench
