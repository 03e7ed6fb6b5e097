#include "clench/grasp/wrench/grasp_dofs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"

namespace clench {

namespace {

// of meters and radians: far above the rounding of 32 bits
constexpr double apart = 1e-6;

bool differ(double a, double b) { return !(std::abs(a - b) <= apart * std::max(1.0, std::abs(b))); }

// links moved by joints; links without joints are parts of their parents
void add_moved(const Robot& robot, const std::vector<std::vector<int>>& children, int link,
               std::vector<int>& out) {
  for (const int child : children[static_cast<size_t>(link + 1)]) {
    if (robot.links[child].first_joint < robot.links[child].end_joint)
      out.push_back(child);
    else
      add_moved(robot, children, child, out);
  }
}

std::vector<std::string> names_of_dofs(const Robot& robot) {
  std::vector<std::string> names;
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) names.push_back(dof_name(robot, d));
  return names;
}

// the joint that a DOF is named after, otherwise the first that it moves
int leading_joint(const Robot& robot, int dof) {
  int first = -1;
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.dof != dof) continue;
    if (!joint.name.empty() && joint.name == robot.dofs[dof].name) return j;
    if (first < 0) first = j;
  }
  return first;
}

std::vector<int> breadth_first_dofs(const Robot& robot) {
  std::vector<int> leading;
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d)
    leading.push_back(leading_joint(robot, d));
  std::vector<int> out;
  for (const int j : breadth_first_joints(robot))
    if (const int d = robot.joints[j].dof; leading[d] == j) out.push_back(d);
  // a DOF without joints comes last
  for (int d = 0; d < static_cast<int>(leading.size()); ++d)
    if (leading[d] < 0) out.push_back(d);
  return out;
}

// indices of DOFs, or of joints, in the order of the list
std::vector<int> listed_order(const Robot& robot, bool of_dofs, bool isaac) {
  if (isaac) return of_dofs ? breadth_first_dofs(robot) : breadth_first_joints(robot);
  std::vector<int> out(of_dofs ? robot.dofs.size() : robot.joints.size());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// A value of the list: of a DOF, or of a joint.
struct Listed {
  int dof = 0, joint = -1;  ///< -1: of the DOF itself
  double value = 0;
  size_t place = 0;  ///< in the list
};

class PostureReader {
 public:
  PostureReader(const World& world, Id<Robot> hand, const Place& place,
                const GraspDofOptions& options)
      : robot_(world.robot(hand)), place_(place), options_(options) {}

  /// Listed values, the others as in `q`.
  Eigen::VectorXd read(const std::vector<double>& values, const std::vector<std::string>& names,
                       const std::vector<std::string>& units, Eigen::VectorXd q) const {
    const auto list = names.empty() ? in_order(values) : by_name(values, names);
    for (const Listed& one : list)
      check_unit(one, one.place < units.size() ? units[one.place] : "");
    std::vector<bool> known(robot_.dofs.size());
    // a DOF's own value comes before those of its joints
    for (const bool own : {true, false})
      for (const Listed& one : list) {
        if ((one.joint < 0 || is_leading(one.joint)) != own || known[one.dof]) continue;
        if (one.joint < 0) {
          q[one.dof] = one.value;
        } else {
          const Joint& joint = robot_.joints[one.joint];
          if (joint.ratio == 0) continue;
          q[one.dof] = (one.value - joint.offset) / joint.ratio;
        }
        known[one.dof] = true;
      }
    compare_followers(list, q);
    return q;
  }

  Eigen::VectorXd within(const Eigen::VectorXd& q) const {
    Eigen::VectorXd out = q;
    for (int d = 0; d < q.size(); ++d)
      out[d] = near_limits(robot_, d, q[d], place_, options_.diagnostics);
    return out;
  }

 private:
  bool is_leading(int joint) const {
    return leading_joint(robot_, robot_.joints[joint].dof) == joint;
  }

  std::vector<Listed> by_name(const std::vector<double>& values,
                              const std::vector<std::string>& names) const {
    const auto dofs = names_of_dofs(robot_), joints = joint_names(robot_);
    std::vector<Listed> out;
    for (size_t i = 0; i < values.size(); ++i) {
      const std::string& name = names[i];
      if (const auto d = std::ranges::find(dofs, name); d != dofs.end()) {
        out.push_back({.dof = static_cast<int>(d - dofs.begin()), .value = values[i], .place = i});
        continue;
      }
      const auto found = std::ranges::find(joints, name);
      if (name.empty() || found == joints.end())
        fail("{}: the hand has no DOF {}{}", place_, in_quotes(name), instead_of(name, dofs));
      const auto j = static_cast<int>(found - joints.begin());
      out.push_back({.dof = robot_.joints[j].dof, .joint = j, .value = values[i], .place = i});
    }
    return out;
  }

  // one value per DOF, or one per joint: other programs list followers, too
  std::vector<Listed> in_order(const std::vector<double>& values) const {
    std::vector<Listed> out;
    if (values.empty()) return out;
    const bool of_dofs = values.size() == robot_.dofs.size();
    if (!of_dofs && values.size() != robot_.joints.size())
      fail("{}: it has {} DOFs and 0 joints, the hand {} and {}", place_, values.size(),
           robot_.dofs.size(), robot_.joints.size());
    const auto own = listed_order(robot_, of_dofs, false),
               isaac = listed_order(robot_, of_dofs, true);
    if (options_.order == DofOrder::unknown && isaac != own)
      options_.diagnostics.warn(place_,
                                "it does not name its DOFs, which are taken in the hand's order: "
                                "{}; Isaac Sim's order is {}, for dof_order = \"isaac\"",
                                order_text(own, of_dofs), order_text(isaac, of_dofs));
    const auto& order = options_.order == DofOrder::isaac ? isaac : own;
    for (size_t i = 0; i < order.size(); ++i)
      out.push_back({.dof = of_dofs ? order[i] : robot_.joints[order[i]].dof,
                     .joint = of_dofs ? -1 : order[i],
                     .value = values[i],
                     .place = i});
    return out;
  }

  std::string order_text(const std::vector<int>& order, bool of_dofs) const {
    std::vector<std::string> names;
    for (const int i : order) names.push_back(of_dofs ? dof_name(robot_, i) : joint_name(i));
    return name_list(names);
  }
  std::string joint_name(int joint) const {
    const std::string& name = robot_.joints[joint].name;
    return name.empty() ? fmt::format("joint {}", joint + 1) : name;
  }

  void check_unit(const Listed& one, const std::string& unit) const {
    const std::string own = dof_slides(robot_, one.dof) ? "m" : "rad";
    if ((unit == "rad" || unit == "m") && unit != own)
      fail("{}: DOF {}: expected a value in {}, got one in {}", place_,
           in_quotes(dof_name(robot_, one.dof)), own, unit);
  }

  void compare_followers(const std::vector<Listed>& list, const Eigen::VectorXd& q) const {
    for (const Listed& one : list) {
      if (one.joint < 0) continue;
      const Joint& joint = robot_.joints[one.joint];
      const double by_dof = joint.ratio * q[one.dof] + joint.offset;
      if (differ(one.value, by_dof))
        options_.diagnostics.warn(
            place_,
            "joint {} moves with DOF {}, which puts it at {:.6g}, not at {:.6g}; the DOF is used",
            in_quotes(joint_name(one.joint)), in_quotes(dof_name(robot_, one.dof)), by_dof,
            one.value);
    }
  }

  const Robot& robot_;
  const Place& place_;
  const GraspDofOptions& options_;
};

// joints of rigid DOFs must be at the positions given by their DOFs
void check_rigid_joints(const Robot& robot, const Eigen::VectorXd& q,
                        const std::vector<double>& joints, const Place& place) {
  for (size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    const double by_dof = joint.ratio * q[joint.dof];
    if (robot.dofs[joint.dof].kind == DofKind::rigid && differ(joints[j], by_dof))
      fail("{}: joint {} is at {}, but its DOF puts it at {}; omit 'joints' to use the DOFs alone",
           place, j + 1, joints[j], by_dof);
  }
}

}  // namespace

std::vector<int> breadth_first_joints(const Robot& robot) {
  std::vector<std::vector<int>> children(robot.links.size() + 1);
  for (size_t l = 0; l < robot.links.size(); ++l)
    children[static_cast<size_t>(robot.links[l].parent + 1)].push_back(static_cast<int>(l));
  // each joint of a link with several joints is a separate level
  std::vector<int> out;
  struct Level {
    int link, joint;
  };
  std::vector<Level> level;
  const auto open = [&](int link, std::vector<Level>& to) {
    std::vector<int> links;
    add_moved(robot, children, link, links);
    for (const int m : links) to.push_back({m, robot.links[m].first_joint});
  };
  open(-1, level);
  while (!level.empty()) {
    std::vector<Level> next;
    for (const Level& at : level) {
      out.push_back(at.joint);
      if (at.joint + 1 < robot.links[at.link].end_joint)
        next.push_back({at.link, at.joint + 1});
      else
        open(at.link, next);
    }
    level = std::move(next);
  }
  return out;
}

std::vector<std::string> listed_dof_names(const Robot& robot, size_t count, DofOrder order) {
  const bool of_dofs = count == robot.dofs.size();
  if (!of_dofs && count != robot.joints.size())
    fail("dof_order: expected as many values as '{}' has DOFs, {}, or joints, {}, got {}",
         excerpt(robot.name), robot.dofs.size(), robot.joints.size(), count);
  std::vector<std::string> out;
  for (const int i : listed_order(robot, of_dofs, order == DofOrder::isaac)) {
    out.push_back(of_dofs ? dof_name(robot, i) : robot.joints[i].name);
    if (out.back().empty())
      fail("dof_order: joint {} of '{}' has no name", i + 1, excerpt(robot.name));
  }
  return out;
}

GraspPosture grasp_posture(const World& world, Id<Robot> hand, const GraspSpec& grasp,
                           const Place& place, const GraspDofOptions& options) {
  const Robot& robot = world.robot(hand);
  // joint positions are listed for a hand with the same joints
  const bool own_joints = !grasp.joints.empty();
  if (own_joints &&
      (grasp.dofs.size() != robot.dofs.size() || grasp.joints.size() != robot.joints.size()))
    fail("{}: it has {} DOFs and {} joints, the hand {} and {}", place, grasp.dofs.size(),
         grasp.joints.size(), robot.dofs.size(), robot.joints.size());
  GraspDofOptions of_values = options;
  if (own_joints && options.order == DofOrder::unknown) of_values.order = DofOrder::hand;
  const PostureReader reader(world, hand, place, of_values);
  const Eigen::VectorXd listed =
      reader.read(grasp.dofs, grasp.dof_names, grasp.dof_units, world.dofs(hand));
  if (own_joints) check_rigid_joints(robot, listed, grasp.joints, place);
  GraspPosture out{reader.within(listed), {}};
  if (!own_joints) return out;
  out.own.resize(grasp.joints.size());
  for (size_t j = 0; j < out.own.size(); ++j) {
    const Joint& joint = robot.joints[j];
    const bool rigid = robot.dofs[joint.dof].kind == DofKind::rigid;
    // a rigid joint follows its DOF to the limit
    if (rigid && differ(grasp.joints[j], joint.ratio * out.dofs[joint.dof])) continue;
    out.own[j] = rigid ? grasp.joints[j]
                       : joint_near_limits(robot, static_cast<int>(j), grasp.joints[j], place,
                                           options.diagnostics);
  }
  return out;
}

Eigen::VectorXd pregrasp_dofs(const World& world, Id<Robot> hand, const GraspSpec& grasp,
                              const GraspPosture& posture, const Place& place,
                              const GraspDofOptions& options) {
  const auto& values = grasp.pregrasp->dofs;
  const Place before = place.of("pregrasp");
  const bool named = !grasp.dof_names.empty();
  if (named && !values.empty() && values.size() != grasp.dof_names.size())
    fail("{}: expected {} values, one per name of a DOF, got {}", before, grasp.dof_names.size(),
         values.size());
  GraspDofOptions of_values = options;
  // the grasp itself has already warned of the order
  if (options.order == DofOrder::unknown && !grasp.dofs.empty()) of_values.order = DofOrder::hand;
  const PostureReader reader(world, hand, before, of_values);
  return reader.within(reader.read(values, grasp.dof_names, grasp.dof_units, posture.dofs));
}

}  // namespace clench
