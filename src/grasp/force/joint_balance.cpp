#include "clench/grasp/force/joint_balance.h"

#include <limits>
#include <map>

#include "clench/grasp/force/link_weight.h"
#include "clench/model/effort_range.h"

namespace clench {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

double limit_or_none(double effort) { return effort > 0 ? effort : no_limit; }

template <class Visit>
void each_joint_of(const Robot& robot, int dof, Visit visit) {
  for (const Joint& joint : robot.joints)
    if (joint.dof == dof) visit(joint);
}

// effort of a joint's spring in its present position
double spring_of(const World& world, const JointRef& ref) {
  const Joint& joint = world.robot(ref.robot).joints[ref.joint];
  return joint.spring > 0 ? -joint.spring * (world.joints(ref.robot)[ref.joint] - joint.rest) : 0;
}

// shares of the joints of a compliant DOF in its effort: in free air the tendon balances their
// springs, and its work equals the DOF's
struct TendonShares {
  bool sprung = true;  // has each joint a spring?
  double work = 0;     // of free motion: sum of k ratio^2, or of ratio^2

  TendonShares(const Robot& robot, int dof) {
    each_joint_of(robot, dof, [&](const JointSpec& j) { sprung = sprung && j.spring > 0; });
    each_joint_of(robot, dof,
                  [&](const JointSpec& j) { work += (sprung ? j.spring : 1) * j.ratio * j.ratio; });
  }
  double of(const JointSpec& joint) const {
    return (sprung ? joint.spring : 1) * joint.ratio / work;
  }
};

// effort of a compliant DOF's motor that keeps its position in free air: the work of its springs
// along its motion
double tendon_effort(const World& world, Id<Robot> id, int dof) {
  const Robot& robot = world.robot(id);
  const double q = world.dofs(id)[dof];
  double sum = 0;
  if (robot.dofs[dof].kind == DofKind::compliant)
    each_joint_of(robot, dof,
                  [&](const JointSpec& j) { sum += j.ratio * j.spring * (j.ratio * q - j.rest); });
  return sum;
}

struct Row {
  Eigen::VectorXd forces;
  int effort = 0;     // its source
  double factor = 1;  // of the effort
  double spring = 0;
  double slack = 0;
};

// the rows and the efforts that they share, joint by joint
class BalanceRows {
 public:
  BalanceRows(const World& world, const Grasp& grasp, const HandJacobian& jacobian)
      : world_(world) {
    std::vector<Id<Robot>> robots = {grasp.hand};
    for (const JointRef& ref : jacobian.joints)
      if (ref.robot != robots.back()) robots.push_back(ref.robot);
    for (const Id<Robot> robot : robots) add_motors(robot);
  }

  void add(const JointRef& ref, const Eigen::VectorXd& forces, bool link_weights);
  JointBalance finish(Eigen::Index unknown_forces) const;

 private:
  void add_motors(Id<Robot> robot) {
    for (int i = 0; i < static_cast<int>(world_.robot(robot).dofs.size()); ++i) {
      const EffortRange range = effort_range(world_, robot, i);
      motors_[{robot, i}] = add_effort({robot, i}, range.low, range.high);
      tendons_.push_back(tendon_effort(world_, robot, i));
    }
  }
  int add_effort(const EffortRef& ref, double least, double most) {
    refs_.push_back(ref);
    low_.push_back(least), high_.push_back(most);
    return static_cast<int>(refs_.size()) - 1;
  }

  const World& world_;
  std::vector<EffortRef> refs_;
  std::vector<double> low_, high_, tendons_;
  std::map<std::pair<Id<Robot>, int>, int> motors_;  // of a robot's DOF: its effort
  std::vector<Row> rows_;
  std::map<int, int> shared_;  // the row of a DOF whose joints are rigidly coupled
};

void BalanceRows::add(const JointRef& ref, const Eigen::VectorXd& forces, bool link_weights) {
  const Robot& robot = world_.robot(ref.robot);
  const Joint& joint = robot.joints[ref.joint];
  const DofSpec& dof = robot.dofs[joint.dof];
  const int motor = motors_.at({ref.robot, joint.dof});
  Row row{forces, motor, joint.ratio, spring_of(world_, ref)};
  if (link_weights) row.spring += link_weight(world_, ref);
  if (dof.kind == DofKind::compliant) {
    row.factor = TendonShares(robot, joint.dof).of(joint);
    row.slack = springs_at_rest * joint.spring;
  } else if (!world_.follows_dof(ref.robot, ref.joint)) {
    row.effort = add_effort({ref.robot, joint.dof, ref}, 0, limit_or_none(dof.breakaway_torque));
    row.factor = joint.ratio < 0 ? -1 : 1;
  } else {
    row.forces *= joint.ratio;
    row.spring *= joint.ratio;
    row.factor = 1;
    const auto [at, fresh] = shared_.try_emplace(motor, static_cast<int>(rows_.size()));
    if (!fresh) {
      rows_[at->second].forces += row.forces;
      rows_[at->second].spring += row.spring;
      return;
    }
  }
  rows_.push_back(std::move(row));
}

JointBalance BalanceRows::finish(Eigen::Index unknown_forces) const {
  const int count = static_cast<int>(rows_.size()), efforts = static_cast<int>(refs_.size());
  JointBalance out;
  out.refs = refs_;
  out.forces.resize(count, unknown_forces);
  out.efforts = Eigen::MatrixXd::Zero(count, efforts);
  out.springs.resize(count);
  out.slack.resize(count);
  for (int i = 0; i < count; ++i) {
    out.forces.row(i) = rows_[i].forces;
    out.efforts(i, rows_[i].effort) = rows_[i].factor;
    out.springs[i] = rows_[i].spring;
    out.slack[i] = rows_[i].slack;
  }
  const auto vector = [](const std::vector<double>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<int>(x.size()));
  };
  // clutches have none
  out.tendons = Eigen::VectorXd::Zero(efforts);
  out.tendons.head(static_cast<int>(tendons_.size())) = vector(tendons_);
  out.low = vector(low_), out.high = vector(high_);
  return out;
}

}  // namespace

JointBalance joint_balance(const World& world, const Grasp& grasp, bool arms, bool link_weights) {
  const HandJacobian jacobian = hand_jacobian(world, grasp, {.arms = arms});
  BalanceRows rows(world, grasp, jacobian);
  for (int k = 0; k < static_cast<int>(jacobian.joints.size()); ++k)
    rows.add(jacobian.joints[k], jacobian.of_joints.col(k), link_weights);
  return rows.finish(jacobian.of_joints.rows());
}

}  // namespace clench
