#include "clench/motion/inverse_kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/math/decompositions.h"
#include "clench/model/carrying.h"
#include "clench/model/dof.h"
#include "clench/model/jacobian.h"

namespace clench {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double turn_length = 0.1;  // a turn by 1 rad is weighted like this displacement [m]
constexpr int max_iterations = 300;  // per start
constexpr double no_step = 1e-12;    // smaller steps end the descent [rad or m]
constexpr double min_damping = 1e-9, max_damping = 1e9;  // relative to the squared error

// values of the DOFs, and the remaining error of the frame
struct Posture {
  VectorXd q;
  // displacement to the target, above turn_length * remaining turn, in world axes [m]
  Vector6d residual;
  double distance = 0, angle = 0;

  double error() const { return residual.squaredNorm(); }
};

class Search {
 public:
  Search(const World& world, Id<Robot> id, Id<Body> body, const Pose& X_WT,
         const IkOptions& options)
      : robot_(world.robot(id)),
        link_(carrying_link(world, id, body)),
        X_W_base_(world.pose(robot_.base)),
        X_WT_(X_WT),
        options_(options),
        joints_(robot_.joints.size()) {
    X_LT_ = world.pose(robot_.body_of(link_)).inverse() * world.pose(body) * options.X_BT;
    free_.assign(robot_.dofs.size(), options.dofs.empty());
    for (const int dof : options.dofs) free_[dof] = true;
    for (int d = 0; d < static_cast<int>(robot_.dofs.size()); ++d)
      ranges_.push_back(range_around(robot_, d, world.dofs(id)[d]));
  }

  bool moves_anything() const {
    for (int j = 0; j < static_cast<int>(robot_.joints.size()); ++j)
      if (free_[robot_.joints[j].dof] && joint_moves_link(robot_, j, link_)) return true;
    return false;
  }
  bool may_move(int dof) const { return free_[dof]; }
  bool reached(const Posture& at) const {
    return at.distance <= options_.tolerance && at.angle <= options_.angle_tolerance;
  }
  /// The posture with the smallest error that descent finds from q.
  Posture descend(const VectorXd& q, int& iterations);

 private:
  Posture at(const VectorXd& q);
  MatrixXd jacobian() const;

  const Robot& robot_;
  int link_;
  Pose X_W_base_, X_LT_, X_WT_;
  const IkOptions& options_;
  std::vector<bool> free_;  // per DOF
  std::vector<std::array<double, 2>> ranges_;
  // of the posture evaluated last
  std::vector<double> joints_;
  RobotFrames frames_;
  Pose X_WT_now_;
};

Posture Search::at(const VectorXd& q) {
  for (size_t j = 0; j < joints_.size(); ++j)
    joints_[j] = robot_.joints[j].ratio * q[robot_.joints[j].dof];
  find_frames(robot_, X_W_base_, joints_, frames_);
  X_WT_now_ = frames_.links[link_] * X_LT_;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  if (options_.orientation == IkOrientation::full)
    turn = X_WT_.rotation * X_WT_now_.rotation.conjugate();
  else if (options_.orientation == IkOrientation::axis)
    turn = shortest_rotation(turned(X_WT_now_.rotation, Vector3d::UnitZ()),
                             turned(X_WT_.rotation, Vector3d::UnitZ()));
  Posture out{q, {}, 0, Pose::turn(turn).angle()};
  const Vector3d way = X_WT_.position - X_WT_now_.position;
  const Vector3d axis = std::copysign(1.0, turn.w()) * turn.vec().stableNormalized();
  out.residual << way, turn_length * out.angle * axis;
  out.distance = way.norm();
  return out;
}

// derivative of the pose by the DOFs, the negative of the residual's; 0 for DOFs that must not move
MatrixXd Search::jacobian() const {
  const MatrixXd joints = joint_jacobian(robot_, frames_, link_, X_WT_now_.position);
  MatrixXd out = MatrixXd::Zero(6, static_cast<int>(free_.size()));
  for (int j = 0; j < joints.cols(); ++j) {
    const Joint& joint = robot_.joints[j];
    if (free_[joint.dof]) out.col(joint.dof) += joint.ratio * joints.col(j);
  }
  out.bottomRows<3>() *= options_.orientation == IkOrientation::none ? 0.0 : turn_length;
  if (options_.orientation == IkOrientation::axis) {
    const Vector3d z = turned(X_WT_now_.rotation, Vector3d::UnitZ());
    out.bottomRows<3>() -= z * (z.transpose() * out.bottomRows<3>()).eval();
  }
  return out;
}

Posture Search::descend(const VectorXd& start, int& iterations) {
  Posture best = at(start);
  double damping = 1e-2;
  for (int i = 0; i < max_iterations && !reached(best); ++i) {
    ++iterations;
    MatrixXd J = jacobian();
    const VectorXd downhill = J.transpose() * best.residual;
    // fix DOFs at the end of their range
    for (int d = 0; d < J.cols(); ++d) {
      const auto [low, high] = ranges_[d];
      if ((best.q[d] <= low && downhill[d] < 0) || (best.q[d] >= high && downhill[d] > 0))
        J.col(d).setZero();
    }
    const MatrixXd H = J.transpose() * J;
    const VectorXd slope = J.transpose() * best.residual;
    // reduce the damping after a step that improves, increase it until one does
    while (true) {
      check_stop();
      MatrixXd damped = H;
      damped.diagonal().array() += damping * best.error() + 1e-15;
      VectorXd q = best.q + solve_symmetric(damped, slope);
      for (int d = 0; d < q.size(); ++d)
        if (free_[d]) q[d] = std::clamp(q[d], ranges_[d][0], ranges_[d][1]);
      const double step = (q - best.q).lpNorm<Eigen::Infinity>();
      if (!(step > no_step)) return best;
      Posture next = at(q);
      if (next.error() < best.error()) {
        best = std::move(next);
        damping = std::max(damping / 10, min_damping);
        break;
      }
      if (damping > max_damping) return best;
      damping *= 10;
    }
  }
  return best;
}

void check(const World& world, Id<Robot> id, const Pose& X_WT, const IkOptions& options) {
  const Robot& robot = world.robot(id);
  const auto subject = [&] {
    return fmt::format("inverse kinematics of '{}'", excerpt(robot.name));
  };
  if (!X_WT.is_finite() || !options.X_BT.is_finite()) fail("{}: expected a finite pose", subject());
  check_dof_numbers(robot, options.dofs, "inverse kinematics");
  if (options.starts < 1 || options.starts > 1'000'000)
    fail("{}: starts: expected 1 to 1000000, got {}", subject(), options.starts);
  for (const double tolerance : {options.tolerance, options.angle_tolerance})
    if (!(tolerance > 0)) fail("{}: expected a tolerance > 0, got {}", subject(), tolerance);
}

// random value of one DOF
double random_value(const std::array<double, 2>& range, double now, Random& random) {
  const bool endless = !std::isfinite(range[1] - range[0]);
  const double low = endless ? std::max(range[0], now - std::numbers::pi) : range[0];
  const double high = endless ? std::min(range[1], now + std::numbers::pi) : range[1];
  return std::clamp(random.uniform(low, high), range[0], range[1]);
}

}  // namespace

IkResult inverse_kinematics(const World& world, Id<Robot> id, Id<Body> body, const Pose& X_WT,
                            const IkOptions& options, QueryContext* context) {
  check(world, id, X_WT, options);
  Search search(world, id, body, X_WT, options);
  const Robot& robot = world.robot(id);
  if (!search.moves_anything())
    fail("inverse kinematics of '{}': none of the selected DOFs moves '{}'", excerpt(robot.name),
         excerpt(world.body(body).name));
  std::optional<World> trial;  // copy of the world for collision checks
  std::vector<Id<Body>> moving;
  if (options.collision_free) trial = world, moving = movable_bodies(world, id);
  const auto collides_at = [&](const VectorXd& q) {
    if (!trial) return false;
    trial->set_dofs_unchecked(id, q, std::vector<JointPosition>(robot.joints.size()));
    return !colliding_pairs(*trial, moving, trial->bodies(), &trial->context()).empty();
  };

  IkResult out;
  double least = std::numeric_limits<double>::infinity();
  const VectorXd now = world.dofs(id);
  for (Random random(options.seed); !out.reached && out.starts < options.starts; ++out.starts) {
    if (context) context->progress().check();
    check_stop();
    VectorXd start = now;
    for (int d = 0; d < start.size() && out.starts > 0; ++d)
      if (search.may_move(d))
        start[d] = random_value(range_around(robot, d, now[d]), now[d], random);
    const Posture end = search.descend(start, out.iterations);
    const bool there = search.reached(end), collision = there && collides_at(end.q);
    out.in_collision += collision;
    out.reached = there && !collision;
    if (!out.reached && !(end.error() < least)) continue;
    least = end.error();
    out.dofs = end.q, out.distance = end.distance, out.angle = end.angle;
  }
  return out;
}

VectorXd random_posture(const World& world, Id<Robot> id, Random& random) {
  const Robot& robot = world.robot(id);
  VectorXd q = world.dofs(id);
  for (int d = 0; d < q.size(); ++d)
    q[d] = random_value(range_around(robot, d, q[d]), q[d], random);
  return q;
}

}  // namespace clench
