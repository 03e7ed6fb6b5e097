#include "clench/dynamics/step/free_motion.h"

#include "clench/base/watched.h"

namespace clench {
namespace {

/// Free motion of one tree.
class FreeMotion {
 public:
  FreeMotion(const World& world, const Articulation& tree, int number, StepProblem& problem)
      : world_(world),
        tree_(tree),
        number_(number),
        problem_(problem),
        dynamics_(problem.trees[number]),
        forces_(problem.forces[number]),
        root_(prescribed_twist(world, tree)) {}

  void solve();

 private:
  auto velocities() { return problem_.v_free.segment(tree_.first, tree_.size()); }
  bool is_gyroscopic();
  void add_mean_bias(Eigen::VectorXd& change);

  const World& world_;
  const Articulation& tree_;
  const int number_;
  StepProblem& problem_;
  TreeDynamics& dynamics_;
  JointForces& forces_;
  const Vector6d root_;
};

// Do joints, or a floating base, turn by more than half a radian in the step? Velocity-dependent
// forces of such velocities would grow from step to step.
bool FreeMotion::is_gyroscopic() {
  constexpr double max_turn = 0.5;  // [rad]
  return !tree_.is_free_body() && velocities().cwiseAbs().maxCoeff() * problem_.h > max_turn;
}

// Velocity-dependent forces are quadratic in the velocities. They are evaluated at the velocities
// of the middle of the step, not of its beginning: with the latter a double pendulum gains a
// twentieth of its energy. c(v + d) = c(v) + (c(v + d) - c(v - d)) / 2 up to terms quadratic in d,
// half the change.
void FreeMotion::add_mean_bias(Eigen::VectorXd& change) {
  auto v = velocities();
  constexpr double slow = 1e-3;  // below it the correction is negligible [m/s, rad/s]
  if (v.cwiseAbs().maxCoeff() < slow || is_gyroscopic()) return;
  const Eigen::VectorXd before = v;
  v = before - change / 2;
  Eigen::VectorXd more = dynamics_.find_bias(problem_.v_free, root_, world_.gravity());
  v = before + change / 2;
  more -= dynamics_.find_bias(problem_.v_free, root_, world_.gravity());
  v = before;
  more /= 2;
  forces_.efforts += more;
  more *= problem_.h;
  dynamics_.half_solve(more);
  dynamics_.other_half_solve(more);
  change += more;
}

void FreeMotion::solve() {
  const DynamicState& state = *world_.dynamics();
  const double h = problem_.h;
  const int n = tree_.size();
  dynamics_.place(world_, tree_);
  if (n == 0) return;
  // velocity-dependent forces are omitted there
  const Eigen::VectorXd still =
      is_gyroscopic() ? Eigen::VectorXd::Zero(problem_.v_free.size()) : Eigen::VectorXd();
  Eigen::VectorXd efforts =
      -dynamics_.find_bias(still.size() > 0 ? still : problem_.v_free, root_, world_.gravity());
  problem_.root_accelerations[number_] = dynamics_.root_acceleration();
  find_joint_forces(world_, tree_, dynamics_, h, state, forces_);
  efforts += forces_.efforts;
  for (size_t i = 0; i < tree_.coordinates.size(); ++i)
    efforts[tree_.root_size() + static_cast<int>(i)] +=
        feedforward_effort(world_, tree_.coordinates[i], state);
  for (size_t b = 0; b < tree_.bodies.size(); ++b) {
    const Load& load = state.loads[tree_.bodies[b].body.index];
    if (load.force.isZero(0) && load.torque.isZero(0)) continue;
    const int body = static_cast<int>(b);
    dynamics_.add_linear(body, dynamics_.com(body), load.force, 1, efforts);
    dynamics_.add_angular(body, load.torque, 1, efforts);
  }
  auto v = velocities();
  dynamics_.factor(forces_.added, forces_.root_added);
  Eigen::VectorXd change = h * efforts - forces_.velocity_part.cwiseProduct(v);
  if (const auto& damped = forces_.root_velocity_part; damped.size() > 0)
    change.head<6>() -= damped * v.head<6>();
  if (!tree_.floating) {
    Vector6d last;
    last << state.solved[tree_.root.index].linear, state.solved[tree_.root.index].angular;
    change += dynamics_.base_impulse(root_ - last);
  }
  dynamics_.half_solve(change);
  dynamics_.other_half_solve(change);
  if (n > 1 && !tree_.is_free_body()) add_mean_bias(change);
  v += change;
}

}  // namespace

void find_free_motion(const World& world, const System& system, StepProblem& problem) {
  problem.trees.resize(system.trees.size());
  problem.forces.resize(system.trees.size());
  problem.root_accelerations.assign(system.trees.size(), Vector6d::Zero());
  gather_velocities(system, world, *world.dynamics(), problem.v_free);
  problem.v_before = problem.v_free;
  for (size_t t = 0; t < system.trees.size(); ++t) {
    check_stop();
    FreeMotion(world, system.trees[t], static_cast<int>(t), problem).solve();
  }
}

}  // namespace clench
