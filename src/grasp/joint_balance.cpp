#include "grasp/joint_balance.h"

#include <limits>
#include <map>

#include "grasp/link_weight.h"

namespace clench {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

double limit_or_none(double effort) { return effort > 0 ? effort : no_limit; }

template <class Visit>
void each_joint_of(const Robot& robot, int dof, Visit visit) {
  for (const Chain& chain : robot.chains)
    for (const JointSpec& joint : chain.joints)
      if (joint.dof == dof) visit(joint);
}

// what a joint's spring gives as it stands
double spring_of(const Robot& robot, const JointRef& ref) {
  const JointSpec& joint = robot.chains[ref.chain].joints[ref.joint];
  return joint.spring > 0 ? -joint.spring * (joint_value(robot, ref.chain, ref.joint) - joint.rest)
                          : 0;
}

// what the joints of a compliant DOF get of its effort: in free air the tendon holds their springs, and does the work
// that the DOF does
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

// what a compliant DOF's motor gives to stand where it does in free air: the work of its springs along its motion
double tendon_effort(const Robot& robot, int dof) {
  double sum = 0;
  if (robot.dofs[dof].kind == DofKind::compliant)
    each_joint_of(robot, dof, [&](const JointSpec& j) {
      sum += j.ratio * j.spring * (j.ratio * robot.q[dof] - j.rest);
    });
  return sum;
}

struct Row {
  Eigen::VectorXd forces;
  int effort = 0;     // whose
  double factor = 1;  // of the effort
  double spring = 0;
  double slack = 0;
};

}  // namespace

JointBalance joint_balance(const World& world, const Grasp& grasp, bool arms, bool link_weights) {
  const HandJacobian jacobian = hand_jacobian(world, grasp, {.arms = arms});
  JointBalance out;
  std::vector<double> low, high;
  std::map<std::pair<Id<Robot>, int>, int> motors;  // of a robot's DOF: its effort
  const auto effort = [&](const EffortRef& ref, double least, double most) {
    out.refs.push_back(ref);
    low.push_back(least), high.push_back(most);
    return static_cast<int>(out.refs.size()) - 1;
  };
  std::vector<Id<Robot>> robots = {grasp.hand};
  for (const JointRef& ref : jacobian.joints)
    if (ref.robot != robots.back()) robots.push_back(ref.robot);
  std::vector<double> tendons;
  for (const Id<Robot> robot : robots)
    for (int i = 0; i < static_cast<int>(world.robot(robot).dofs.size()); ++i) {
      const double most = limit_or_none(world.robot(robot).dofs[i].max_effort);
      motors[{robot, i}] = effort({robot, i}, -most, most);
      tendons.push_back(tendon_effort(world.robot(robot), i));
    }

  std::vector<Row> rows;
  std::map<int, int> shared;  // the row of a DOF whose joints are coupled rigidly
  for (int k = 0; k < static_cast<int>(jacobian.joints.size()); ++k) {
    const JointRef& ref = jacobian.joints[k];
    const Robot& robot = world.robot(ref.robot);
    const Chain& chain = robot.chains[ref.chain];
    const JointSpec& joint = chain.joints[ref.joint];
    const DofSpec& dof = robot.dofs[joint.dof];
    const int motor = motors.at({ref.robot, joint.dof});
    Row row{jacobian.of_joints.col(k), motor, joint.ratio, spring_of(robot, ref)};
    if (link_weights) row.spring += link_weight(world, ref);
    if (dof.kind == DofKind::compliant) {
      row.factor = TendonShares(robot, joint.dof).of(joint);
      row.slack = springs_at_rest * joint.spring;
    } else if (chain.apart[ref.joint]) {
      row.effort = effort({ref.robot, joint.dof, ref}, 0, limit_or_none(dof.breakaway_torque));
      row.factor = joint.ratio < 0 ? -1 : 1;
    } else {
      row.forces *= joint.ratio;
      row.spring *= joint.ratio;
      row.factor = 1;
      const auto [at, fresh] = shared.try_emplace(motor, static_cast<int>(rows.size()));
      if (!fresh) {
        rows[at->second].forces += row.forces;
        rows[at->second].spring += row.spring;
        continue;
      }
    }
    rows.push_back(std::move(row));
  }

  const int count = static_cast<int>(rows.size());
  out.forces.resize(count, jacobian.of_joints.rows());
  out.efforts = Eigen::MatrixXd::Zero(count, static_cast<int>(out.refs.size()));
  out.springs.resize(count);
  out.slack.resize(count);
  for (int i = 0; i < count; ++i) {
    out.forces.row(i) = rows[i].forces;
    out.efforts(i, rows[i].effort) = rows[i].factor;
    out.springs[i] = rows[i].spring;
    out.slack[i] = rows[i].slack;
  }
  tendons.resize(out.refs.size(), 0);
  out.tendons = Eigen::Map<const Eigen::VectorXd>(tendons.data(), static_cast<int>(tendons.size()));
  out.low = Eigen::Map<const Eigen::VectorXd>(low.data(), static_cast<int>(low.size()));
  out.high = Eigen::Map<const Eigen::VectorXd>(high.data(), static_cast<int>(high.size()));
  return out;
}

}  // namespace clench
