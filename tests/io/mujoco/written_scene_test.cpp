// Written scenes, as loaded by MuJoCo and as read again by Clench.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "clench/base/random.h"
#include "clench/contact/materials.h"
#include "clench/io/mjcf_write/written_keys.h"
#include "clench/io/read/read.h"
#include "clench/io/write/write_mjcf.h"
#include "clench/spec/dof_drive.h"
#include "support/folder.h"
#include "support/listening.h"
#include "support/meshes.h"
#include "support/mujoco.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

using RowMatrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// The robots of the catalog.
std::vector<fs::path> catalog_robots() {
  std::vector<fs::path> out;
  for (const char* folder : {"models/hands", "models/arms"})
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".cfg" || entry.path().extension() == ".urdf")
        out.push_back(entry.path());
  std::ranges::sort(out);
  return out;
}

std::array<double, 2> table_friction(const MaterialTable& table, const std::string& a,
                                     const std::string& b) {
  const Friction both = table.friction(table.index(a), table.index(b));
  return {both.statics, both.kinetic};
}

/// A world, the scene written from it, and both readings of the scene.
struct Written {
  TemporaryFolder folder;
  WorldSpec world;
  MaterialTable table;
  std::vector<std::string> warnings;
  MujocoModel model;
  MujocoData data;

  void write(std::vector<WrittenKey> keys = {}, int carriage = -1) {
    for (const PlacedRobot& placed : world.robots)
      for (const OwnFriction& own : placed.robot.frictions) table.add(own);
    SceneRequest request{.world = world, .friction = [this](const auto& a, const auto& b) {
                           return table_friction(table, a, b);
                         }};
    request.keys = std::move(keys);
    request.carriage = carriage;
    write_mjcf(request, path(), {.diagnostics = Listening{.warn = [this](const std::string& text) {
                                   warnings.push_back(text);
                                 }}});
    char error[1000] = "";
    model.reset(mj_loadXML(path().c_str(), nullptr, error, sizeof error));
    INFO(path().string());
    REQUIRE_MESSAGE(model, error);
    data.reset(mj_makeData(model.get()));
    mj_forward(model.get(), data.get());
  }
  fs::path path() const { return folder.path() / "scene.xml"; }
  int id(int type, const std::string& name) const {
    const int out = mj_name2id(model.get(), type, name.c_str());
    REQUIRE_MESSAGE(out >= 0, name);
    return out;
  }
  Pose pose_of(const std::string& body) const {
    const int b = id(mjOBJ_BODY, body);
    const double* q = data->xquat + 4 * b;
    return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), Eigen::Vector3d(data->xpos + 3 * b)};
  }
};

// at a random pose, with DOFs anywhere within their ranges
void add_random_robot(WorldSpec& world, const RobotSpec& robot, Random& random) {
  PlacedRobot placed;
  placed.robot = robot;
  placed.X_WB = random_pose(random, 1);
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
    const auto range = dof_range(robot, d);
    const double low = std::max(range[0], -3.0), high = std::min(range[1], 3.0);
    placed.dofs.push_back(random.uniform(low, high));
  }
  world.order.push_back({WorldEntry::Kind::robot, static_cast<int>(world.robots.size())});
  world.robots.push_back(std::move(placed));
}

void check_near(const Pose& ours, const Pose& theirs, double within = 1e-9) {
  CHECK((ours.position - theirs.position).norm() < within);
  CHECK(ours.rotation.angularDistance(theirs.rotation) < 1e-7);
}

void check_masses(const Written& written, const BodySpec& body) {
  const int b = written.id(mjOBJ_BODY, body.name);
  const mjModel& m = *written.model;
  CHECK(m.body_mass[b] == doctest::Approx(body.mass).epsilon(1e-12));
  const Pose X = written.pose_of(body.name);
  const Eigen::Vector3d com(written.data->xipos + 3 * b);
  CHECK((X * com_of(body) - com).norm() < 1e-9);
  const Eigen::Matrix3d turn = Eigen::Map<const RowMatrix3>(written.data->ximat + 9 * b);
  const Eigen::Matrix3d theirs =
      turn * Eigen::Vector3d(m.body_inertia + 3 * b).asDiagonal() * turn.transpose();
  const Eigen::Matrix3d R = X.rotation.toRotationMatrix(),
                        ours = R * (body.mass * inertia_of(body)) * R.transpose();
  CHECK((ours - theirs).cwiseAbs().maxCoeff() < 1e-6 * ours.trace());
}

void check_poses(const Written& written, const RobotSpec& robot, const Pose& X_WB,
                 const std::vector<double>& dofs) {
  const auto poses = link_poses(robot, dofs);
  check_near(X_WB, written.pose_of(robot.base.name));
  for (size_t l = 0; l < robot.links.size(); ++l)
    check_near(X_WB * poses[l], written.pose_of(robot.links[l].body.name));
}

// joints of the robot by their names in the scene
std::vector<std::pair<std::string, const JointSpec*>> named_joints(const RobotSpec& robot) {
  std::vector<std::pair<std::string, const JointSpec*>> out;
  const auto names = joint_names_of(joints_of(robot), robot.dofs);
  each_joint(robot, [&](const JointSpec& joint) { out.emplace_back(names[out.size()], &joint); });
  return out;
}

void check_joints(const Written& written, const RobotSpec& robot) {
  const mjModel& m = *written.model;
  for (const auto& [name, joint] : named_joints(robot)) {
    const int j = written.id(mjOBJ_JOINT, name), dof = m.jnt_dofadr[j];
    CHECK(bool(m.jnt_limited[j]) == !joint->endless);
    if (!joint->endless) {
      CHECK(m.jnt_range[2 * j] == doctest::Approx(joint->min + joint->offset));
      CHECK(m.jnt_range[2 * j + 1] == doctest::Approx(joint->max + joint->offset));
    }
    CHECK(m.dof_damping[dof] == joint->viscous);
    CHECK(m.dof_frictionloss[dof] == joint->coulomb);
    CHECK(m.dof_armature[dof] == joint->armature);
    CHECK(m.jnt_stiffness[j] == joint->spring);
  }
}

// forces of DOFs with custom motor laws: those of their first joints
void check_servos(const Written& written, const RobotSpec& robot) {
  const mjModel& m = *written.model;
  int servos = 0;
  for (const DofSpec& dof : robot.dofs) servos += dof.driven && dof.kind != DofKind::compliant;
  if (!robot.actuators.empty()) return;
  int count = 0;
  for (int a = 0; a < m.nu; ++a) {
    const int j = m.actuator_trnid[2 * a];
    for (const auto& [name, joint] : named_joints(robot)) {
      if (written.id(mjOBJ_JOINT, name) != j) continue;
      const DofSpec& dof = robot.dofs[joint->dof];
      if (dof.kind == DofKind::compliant) continue;
      ++count;
      const double most = dof.max_effort / std::abs(joint->ratio);
      CHECK(bool(m.actuator_forcelimited[a]) == (dof.max_effort > 0));
      if (dof.max_effort > 0) CHECK(m.actuator_forcerange[2 * a + 1] == doctest::Approx(most));
      if (dof.kp > 0)
        CHECK(m.actuator_gainprm[mjNGAIN * a] ==
              doctest::Approx(dof.kp / (joint->ratio * joint->ratio)));
      CHECK(m.actuator_biasprm[mjNBIAS * a + 1] == -m.actuator_gainprm[mjNGAIN * a]);
    }
  }
  CHECK(count == servos);
}

// moves all joints of the scene to other values of the DOFs
void pose_joints(const Written& written, const RobotSpec& robot, const std::vector<double>& dofs) {
  for (const auto& [name, joint] : named_joints(robot)) {
    const int j = written.id(mjOBJ_JOINT, name);
    written.data->qpos[written.model->jnt_qposadr[j]] =
        joint->ratio * dofs[static_cast<size_t>(joint->dof)] + joint->offset;
  }
  mj_kinematics(written.model.get(), written.data.get());
}

void check_robot_scene(const RobotSpec& robot, Random& random) {
  Written written;
  add_random_robot(written.world, robot, random);
  const PlacedRobot& placed = written.world.robots[0];
  written.write();
  check_poses(written, robot, placed.X_WB, placed.dofs);
  check_masses(written, robot.base);
  for (const LinkSpec& link : robot.links) check_masses(written, link.body);
  check_joints(written, robot);
  check_servos(written, robot);
  // and in another posture
  WorldSpec other;
  add_random_robot(other, robot, random);
  pose_joints(written, robot, other.robots[0].dofs);
  check_poses(written, robot, placed.X_WB, other.robots[0].dofs);
  // read by Clench, it is the same tree
  const WorldSpec back = read_world(written.path());
  REQUIRE(back.robots.size() == 1);
  const RobotSpec& again = back.robots[0].robot;
  // joints with springs move independently
  const auto springs = [](const DofSpec& dof) { return dof.kind == DofKind::compliant; };
  const bool compliant = std::ranges::any_of(robot.dofs, springs);
  CHECK(again.dofs.size() == (compliant ? named_joints(robot).size() : robot.dofs.size()));
  const auto poses = link_poses(again, back.robots[0].dofs);
  for (size_t l = 0; l < again.links.size(); ++l)
    for (const LinkSpec& link : robot.links)
      if (again.links[l].body.name.ends_with(link.body.name)) {
        const auto ours = link_poses(robot, placed.dofs);
        check_near(placed.X_WB * ours[static_cast<size_t>(&link - robot.links.data())],
                   back.robots[0].X_WB * poses[l]);
        CHECK(again.links[l].body.mass == doctest::Approx(link.body.mass));
      }
}

}  // namespace

TEST_CASE("MuJoCo loads our hands with the same masses, poses, limits and motors") {
  Random random(11);
  const auto robots = catalog_robots();
  CHECK(robots.size() >= 11);
  for (const fs::path& path : robots) {
    CAPTURE(path.string());
    check_robot_scene(read_robot(path), random);
  }
}

TEST_CASE("URDF hands come out as MJCF hands") {
  REQUIRE_SHARED();
  Random random(12);
  int count = 0;
  for (const char* path : {"allegro_hand/allegro_hand_right.urdf", "leap_hand/leap_hand_right.urdf",
                           "shadow_hand/shadow_hand_right.urdf", "barrett_hand/bhand_model.urdf"}) {
    const fs::path file = shared() / "data" / "hands-urdf" / path;
    if (!fs::exists(file)) continue;
    CAPTURE(path);
    check_robot_scene(read_robot(file), random);
    ++count;
  }
  CHECK(count >= 3);
}

TEST_CASE("a hand with its servos at its posture stays there, under its weight") {
  for (const char* path :
       {"models/hands/barrett/barrett.cfg", "models/hands/shadow/shadow.cfg",
        "models/hands/three_finger/three_finger.cfg", "models/hands/dlr/dlr.cfg"}) {
    CAPTURE(std::string(path));
    const RobotSpec robot = read_robot(path);
    Written written;
    PlacedRobot placed;
    placed.robot = robot;
    for (const DofSpec& dof : robot.dofs) placed.dofs.push_back(dof.default_value);
    written.world.order.push_back({WorldEntry::Kind::robot, 0});
    written.world.robots.push_back(placed);
    CollisionSpec collision;
    collision.on = false;
    written.world.collision = collision;
    written.write({present_key(written.world, "start")});
    mj_resetDataKeyframe(written.model.get(), written.data.get(), 0);
    const auto& m = *written.model;
    const Eigen::VectorXd before = Eigen::Map<Eigen::VectorXd>(written.data->qpos, m.nq);
    for (int i = 0; i < 1000; ++i) mj_step(written.model.get(), written.data.get());
    const Eigen::VectorXd now = Eigen::Map<Eigen::VectorXd>(written.data->qpos, m.nq);
    CHECK((now - before).cwiseAbs().maxCoeff() < 2e-3);
  }
}

TEST_CASE("joints of one motor stay coupled while something presses on a link") {
  const RobotSpec robot = read_robot("models/hands/adaptive_gripper/adaptive_gripper.cfg");
  Written written;
  PlacedRobot placed;
  placed.robot = robot;
  for (const DofSpec& dof : robot.dofs) placed.dofs.push_back(dof.default_value);
  written.world.order.push_back({WorldEntry::Kind::robot, 0});
  written.world.robots.push_back(placed);
  written.world.collision.emplace().on = false;
  written.write({present_key(written.world, "start")});
  const auto& m = *written.model;
  auto& d = *written.data;
  const auto joints = named_joints(robot);
  REQUIRE(joints.size() == 4);
  REQUIRE(robot.dofs.size() == 1);
  for (const auto& [pressed, spec] : joints) {
    CAPTURE(pressed);
    mj_resetDataKeyframe(&m, &d, 0);
    // corresponds to 5 N at the end of a pad of 40 mm
    d.qfrc_applied[m.jnt_dofadr[written.id(mjOBJ_JOINT, pressed)]] = 0.1;
    for (int i = 0; i < 1000; ++i) mj_step(&m, &d);
    const auto angle = [&](size_t i) {
      const int j = written.id(mjOBJ_JOINT, joints[i].first);
      return (d.qpos[m.jnt_qposadr[j]] - joints[i].second->offset) / joints[i].second->ratio;
    };
    // a pad of 40 mm stays level within a hundredth of a millimeter
    for (size_t i = 1; i < joints.size(); ++i) CHECK(std::abs(angle(i) - angle(0)) < 2.5e-4);
  }
}

TEST_CASE("the keys of a scene put the hand on its carriage, and objects, where they say") {
  Random random(13);
  const RobotSpec robot = read_robot("models/hands/barrett/barrett.cfg");
  for (int i = 0; i < 5; ++i) {
    Written written;
    add_random_robot(written.world, robot, random);
    PlacedBody ball;
    ball.body = read_body("models/objects/sphere.iv");
    ball.X_WB = random_pose(random, 1);
    written.world.order.push_back({WorldEntry::Kind::body, 0});
    written.world.bodies.push_back(ball);
    WrittenKey key = present_key(written.world, "moved");
    WorldSpec other;
    add_random_robot(other, robot, random);
    key.robots[0] = other.robots[0].X_WB;
    key.joints[0] = joints_at(robot, other.robots[0].dofs);
    key.bodies[0] = random_pose(random, 1);
    written.write({present_key(written.world, "start"), key}, 0);
    check_poses(written, robot, written.world.robots[0].X_WB, written.world.robots[0].dofs);
    mj_resetDataKeyframe(written.model.get(), written.data.get(), 1);
    mj_kinematics(written.model.get(), written.data.get());
    check_poses(written, robot, other.robots[0].X_WB, other.robots[0].dofs);
    check_near(key.bodies[0], written.pose_of("sphere"));
    // servos at their targets only compensate the weight
    mj_forward(written.model.get(), written.data.get());
    for (int a = 0; a < written.model->nu; ++a) {
      const int j = written.model->actuator_trnid[2 * a];
      CHECK(written.data->ctrl[a] ==
            doctest::Approx(written.data->qpos[written.model->jnt_qposadr[j]]).epsilon(1e-9));
    }
  }
}

TEST_CASE("friction of every pair that can touch is that of the world") {
  // materials whose pairs cannot be expressed by coefficients of single geoms
  Written written;
  for (const char* material : {"rubber", "rubber", "glass", "metal", "stone"}) {
    PlacedBody ball;
    ball.body = read_body("models/objects/sphere.iv");
    ball.body.name = fmt::format("ball {}", written.world.bodies.size());
    ball.body.material = material;
    // all overlap
    ball.X_WB = Pose::translation({0.01 * static_cast<double>(written.world.bodies.size()), 0, 0});
    written.world.order.push_back(
        {WorldEntry::Kind::body, static_cast<int>(written.world.bodies.size())});
    written.world.bodies.push_back(ball);
  }
  written.write();
  int pairs = 0;
  for (int c = 0; c < written.data->ncon; ++c) {
    const mjContact& contact = written.data->contact[c];
    const auto material = [&](int geom) {
      const int body = written.model->geom_bodyid[geom];
      return written.world.bodies[static_cast<size_t>(body - 1)].body.material;
    };
    const auto both =
        table_friction(written.table, material(contact.geom1), material(contact.geom2));
    CHECK(contact.friction[0] == doctest::Approx(both[0]));
    ++pairs;
  }
  CHECK(pairs >= 10);
}
