#include "clench/io/mjcf_write/written_keys.h"

namespace clench {

// target coordinates of the servos of joints
static std::vector<double> targets_of(const WrittenKey& key, const SceneRequest& request,
                                      int robot) {
  const auto r = static_cast<size_t>(robot);
  const bool has_targets = r < key.targets.size() && !key.targets[r].empty();
  std::vector<double> out = has_targets ? key.targets[r] : key.joints[r];
  size_t j = 0;
  each_joint(request.world.robots[static_cast<size_t>(robot)].robot,
             [&](const JointSpec& joint) { out[j] += joint.offset, ++j; });
  return out;
}

std::vector<double> positions_of(const WrittenKey& key, const WrittenScene& scene,
                                 const Carriage& carriage) {
  std::vector<double> out;
  for (const WrittenBody& body : scene.bodies) {
    if (body.free) {
      const Pose& X = body.body >= 0 ? key.bodies[static_cast<size_t>(body.body)]
                                     : key.robots[static_cast<size_t>(body.robot)];
      const Eigen::Quaterniond& q = X.rotation;
      out.insert(out.end(),
                 {X.position.x(), X.position.y(), X.position.z(), q.w(), q.x(), q.y(), q.z()});
    }
    if (body.carried)
      for (const double x : carriage.coordinates(key.robots[static_cast<size_t>(body.robot)]))
        out.push_back(x);
    for (const WrittenJoint& joint : body.joints)
      out.push_back(joint.coordinate(
          key.joints[static_cast<size_t>(joint.robot)][static_cast<size_t>(joint.number)]));
  }
  return out;
}

std::vector<double> controls_of(const WrittenKey& key, const SceneRequest& request,
                                const WrittenDrives& drives, const Carriage& carriage) {
  std::vector<double> out;
  if (!carriage.axes.empty())
    out = carriage.coordinates(key.robots[static_cast<size_t>(request.carriage)]);
  for (const WrittenActuator& a : drives.actuators) {
    const auto r = static_cast<size_t>(a.robot);
    const double effort =
        r < key.efforts.size() && a.dof >= 0 && a.dof < static_cast<int>(key.efforts[r].size())
            ? key.efforts[r][static_cast<size_t>(a.dof)]
            : 0;
    out.push_back(control_for(a, targets_of(key, request, a.robot), effort));
  }
  return out;
}

std::vector<std::string> unmoved_in(const WrittenKey& key, const WrittenScene& scene) {
  std::vector<std::string> out;
  for (const WrittenBody& body : scene.bodies) {
    if (body.free || body.carried || body.parent >= 0) continue;
    const bool is_base = body.robot >= 0 && body.link < 0;
    if (body.body < 0 && !is_base) continue;
    const Pose& X = is_base ? key.robots[static_cast<size_t>(body.robot)]
                            : key.bodies[static_cast<size_t>(body.body)];
    if (!(X == body.X_WB)) out.push_back(body.name);
  }
  return out;
}

WrittenKey key_of(const WorldSpec& world, const KeyframeSpec& keyframe) {
  WrittenKey out = present_key(world, keyframe.name);
  for (const auto& placed : keyframe.bodies)
    out.bodies[static_cast<size_t>(placed.body)] = placed.X_WB;
  for (const auto& placed : keyframe.robots) {
    const auto r = static_cast<size_t>(placed.robot);
    if (placed.X_WB) out.robots[r] = *placed.X_WB;
    out.joints[r] = joints_at(world.robots[r].robot, placed.dofs);
  }
  return out;
}

std::vector<double> joints_at(const RobotSpec& robot, const std::vector<double>& dofs) {
  std::vector<double> out;
  each_joint(robot, [&](const JointSpec& joint) {
    out.push_back(joint.ratio * dofs[static_cast<size_t>(joint.dof)]);
  });
  return out;
}

WrittenKey present_key(const WorldSpec& world, const std::string& name) {
  WrittenKey out;
  out.name = name;
  for (const PlacedBody& placed : world.bodies) out.bodies.push_back(placed.X_WB);
  for (const PlacedRobot& placed : world.robots) {
    out.robots.push_back(placed.X_WB);
    std::vector<double> q;
    each_joint(placed.robot, [&](const JointSpec& joint) {
      const size_t j = q.size();
      const JointPosition own =
          j < placed.joint_positions.size() ? placed.joint_positions[j] : JointPosition();
      q.push_back(own ? *own : joint.ratio * placed.dofs[static_cast<size_t>(joint.dof)]);
    });
    out.joints.push_back(std::move(q));
  }
  return out;
}

}  // namespace clench
