#include "clench/io/mjcf_write/written_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clench {

namespace {

Pose robot_base_pose(const WorldSpec& world, int robot) {
  return world.robots[static_cast<size_t>(robot)].X_WB;
}

class ScenePlanner {
 public:
  explicit ScenePlanner(const SceneRequest& request) : request_(request), world_(request.world) {}
  WrittenScene plan();

 private:
  int add(const BodySpec& spec, int parent, const Pose& X_WB);
  void add_body(int number);
  void add_robot(int number, int parent);
  void add_links(int robot, int link, int parent, const std::vector<double>& q);
  void add_link(int robot, int link, int parent, const std::vector<double>& q);
  void add_carried(int robot, int link, int parent);
  std::vector<double> positions(const PlacedRobot& placed) const;
  bool is_carried(int robot) const;

  const SceneRequest& request_;
  const WorldSpec& world_;
  WrittenScene out_;
  std::vector<std::string> body_names_ = {"world"}, joint_names_;  // "world" is reserved by MuJoCo
  std::vector<std::vector<std::string>> names_of_joints_;          // per robot
};

int ScenePlanner::add(const BodySpec& spec, int parent, const Pose& X_WB) {
  const int number = static_cast<int>(out_.bodies.size());
  WrittenBody body;
  body.name = unique_name(spec.name, body_names_);
  body.spec = &spec;
  body.parent = parent;
  body.X_WB = X_WB;
  out_.bodies.push_back(std::move(body));
  (parent < 0 ? out_.roots : out_.bodies[static_cast<size_t>(parent)].children).push_back(number);
  return number;
}

void ScenePlanner::add_body(int number) {
  const PlacedBody& placed = world_.bodies[static_cast<size_t>(number)];
  WrittenBody& body = out_.bodies[static_cast<size_t>(add(placed.body, -1, placed.X_WB))];
  body.free = placed.role == Role::object;
  body.body = number;
}

// positions of all joints: individual ones, or those given by their DOFs
std::vector<double> ScenePlanner::positions(const PlacedRobot& placed) const {
  std::vector<double> out;
  each_joint(placed.robot, [&](const JointSpec& joint) {
    const size_t j = out.size();
    const JointPosition own =
        j < placed.joint_positions.size() ? placed.joint_positions[j] : JointPosition();
    out.push_back(own ? *own : joint.ratio * placed.dofs[static_cast<size_t>(joint.dof)]);
  });
  return out;
}

void ScenePlanner::add_robot(int number, int parent) {
  const auto n = static_cast<size_t>(number);
  const PlacedRobot& placed = world_.robots[n];
  const int base = add(placed.robot.base, parent, placed.X_WB);
  WrittenBody& body = out_.bodies[static_cast<size_t>(base)];
  body.robot = number;
  body.carried = request_.carriage == number;
  body.free = parent < 0 && placed.floating && !body.carried;
  out_.parts[n].assign(placed.robot.links.size() + 1, base);
  names_of_joints_[n] = joint_names_of(joints_of(placed.robot), placed.robot.dofs);
  add_links(number, -1, base, positions(placed));
}

void ScenePlanner::add_links(int robot, int link, int parent, const std::vector<double>& q) {
  const auto& links = world_.robots[static_cast<size_t>(robot)].robot.links;
  for (size_t l = 0; l < links.size(); ++l)
    if (links[l].parent == link) add_link(robot, static_cast<int>(l), parent, q);
  add_carried(robot, link, parent);
}

void ScenePlanner::add_link(int robot, int link, int parent, const std::vector<double>& q) {
  const auto r = static_cast<size_t>(robot), l = static_cast<size_t>(link);
  const RobotSpec& spec = world_.robots[r].robot;
  const LinkSpec& from = spec.links[l];
  size_t first = 0;
  for (size_t before = 0; before < l; ++before) first += spec.links[before].joints.size();
  Pose X = out_.bodies[static_cast<size_t>(parent)].X_WB;
  std::vector<Pose> frames;
  for (size_t k = 0; k < from.joints.size(); ++k) {
    X = X * from.joints[k].X_PJ;
    frames.push_back(X);
    X = X * joint_motion(from.joints[k], q[first + k]);
  }
  const int number = add(from.body, parent, X * from.X_JL);
  out_.parts[r][l + 1] = number;
  WrittenBody& body = out_.bodies[static_cast<size_t>(number)];
  body.robot = robot;
  body.link = link;
  const Pose X_BW = body.X_WB.inverse();
  for (size_t k = 0; k < from.joints.size(); ++k) {
    WrittenJoint joint;
    joint.name = unique_name(names_of_joints_[r][first + k], joint_names_);
    joint.spec = &from.joints[k];
    joint.robot = robot;
    joint.number = static_cast<int>(first + k);
    joint.anchor = X_BW * frames[k].position;
    joint.axis = X_BW.rotation * (frames[k].rotation * from.joints[k].axis);
    joint.value = q[first + k];
    body.joints.push_back(std::move(joint));
  }
  add_links(robot, link, number, q);
}

// robots attached to the link, and their adapters
void ScenePlanner::add_carried(int robot, int link, int parent) {
  for (const Connection& c : world_.connections) {
    if (c.parent != robot || c.link != link) continue;
    if (c.mount) {
      const int mount = add(*c.mount, parent, robot_base_pose(world_, c.child));
      out_.bodies[static_cast<size_t>(mount)].robot = c.child;
      out_.bodies[static_cast<size_t>(mount)].link = -1;
    }
    add_robot(c.child, parent);
  }
}

bool ScenePlanner::is_carried(int robot) const {
  return std::ranges::any_of(world_.connections,
                             [&](const Connection& c) { return c.child == robot; });
}

WrittenScene ScenePlanner::plan() {
  out_.parts.resize(world_.robots.size());
  names_of_joints_.resize(world_.robots.size());
  for (const WorldEntry& entry : world_.order) {
    if (entry.kind == WorldEntry::Kind::body) add_body(entry.index);
    if (entry.kind == WorldEntry::Kind::robot && !is_carried(entry.index))
      add_robot(entry.index, -1);
  }
  return std::move(out_);
}

}  // namespace

bool WrittenScene::is_below(int body, int ancestor) const {
  while (body >= 0 && body != ancestor) body = bodies[static_cast<size_t>(body)].parent;
  return body == ancestor;
}

bool WrittenScene::stands(int body) const {
  for (; body >= 0; body = bodies[static_cast<size_t>(body)].parent)
    if (bodies[static_cast<size_t>(body)].is_movable()) return false;
  return true;
}

WrittenScene plan_scene(const SceneRequest& request) { return ScenePlanner(request).plan(); }

std::vector<MovedBody> joints_of_dof(const WrittenScene& scene, int robot, int dof) {
  std::vector<MovedBody> out;
  for (size_t b = 0; b < scene.bodies.size(); ++b)
    for (const WrittenJoint& joint : scene.bodies[b].joints)
      if (joint.robot == robot && joint.spec->dof == dof)
        out.push_back({static_cast<int>(b), &joint});
  for (const double ratio : {1.0, -1.0}) {
    const auto found = std::ranges::find_if(
        out, [&](const MovedBody& moved) { return moved.joint->spec->ratio == ratio; });
    if (found == out.end()) continue;
    std::rotate(out.begin(), found, found + 1);
    break;
  }
  return out;
}

DofLoad load_of_dof(const WrittenScene& scene, const std::vector<MovedBody>& joints,
                    const Eigen::Vector3d& gravity) {
  DofLoad out;
  for (const MovedBody& moved : joints)
    out.inertia +=
        moved.joint->spec->ratio * moved.joint->spec->ratio * moved.joint->spec->armature;
  for (size_t b = 0; b < scene.bodies.size(); ++b) {
    const WrittenBody& body = scene.bodies[b];
    const Eigen::Vector3d com = body.X_WB * com_of(*body.spec);
    Eigen::Vector3d v = Eigen::Vector3d::Zero(), w = v;
    for (const MovedBody& moved : joints) {
      if (!scene.is_below(static_cast<int>(b), moved.body)) continue;
      const Pose& X = scene.bodies[static_cast<size_t>(moved.body)].X_WB;
      const Eigen::Vector3d axis = moved.joint->spec->ratio * (X.rotation * moved.joint->axis);
      if (moved.joint->spec->kind == JointKind::prismatic) {
        v += axis;
      } else {
        v += axis.cross(com - X * moved.joint->anchor);
        w += axis;
      }
    }
    if (v.isZero(0) && w.isZero(0)) continue;
    const Eigen::Vector3d own = body.X_WB.rotation.conjugate() * w;
    out.inertia += body.spec->mass * (v.squaredNorm() + own.dot(inertia_of(*body.spec) * own));
    out.weight += body.spec->mass * gravity.dot(v);
  }
  return out;
}

std::string unique_name(const std::string& name, std::vector<std::string>& taken) {
  const std::string stem = name.empty() ? "unnamed" : name;
  std::string out = stem;
  for (int i = 2; std::ranges::find(taken, out) != taken.end(); ++i)
    out = fmt::format("{}_{}", stem, i);
  taken.push_back(out);
  return out;
}

}  // namespace clench
