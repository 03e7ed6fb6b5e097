#include <algorithm>
#include <fstream>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "clench/io/write/urdf_plan.h"
#include "clench/io/write/write_robot.h"
#include "clench/spec/chains.h"
#include "robot_compare.h"
#include "support/chains.h"
#include "support/shapes.h"
#include "support/shared.h"
#include "temporary.h"
#include "written_robot.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

RobotSpec gripper() {
  ReadOptions options;
  options.packages["gripper_description"] = "tests/data/urdf";
  return read_robot("tests/data/urdf/gripper.urdf", options);
}

/// Compares names, ranges, efforts and velocities of DOFs, and the structure of the chains that
/// they move.
void check_same_kinematics(const RobotSpec& a, const RobotSpec& b) {
  CHECK(a.name == b.name);
  REQUIRE(a.dofs.size() == b.dofs.size());
  for (size_t d = 0; d < a.dofs.size(); ++d) {
    CHECK(a.dofs[d].name == b.dofs[d].name);
    CHECK(a.dofs[d].max_effort == b.dofs[d].max_effort);
    CHECK(a.dofs[d].max_velocity == b.dofs[d].max_velocity);
    CHECK(dof_range(a, static_cast<int>(d)) == dof_range(b, static_cast<int>(d)));
  }
  REQUIRE(a.links.size() == b.links.size());
  for (size_t l = 0; l < a.links.size(); ++l) {
    const LinkSpec &x = a.links[l], &y = b.links[l];
    CHECK(x.parent == y.parent);
    REQUIRE(x.joints.size() == y.joints.size());
    for (size_t j = 0; j < x.joints.size(); ++j) {
      CHECK(x.joints[j].name == y.joints[j].name);
      CHECK(x.joints[j].dof == y.joints[j].dof);
      CHECK(x.joints[j].ratio == y.joints[j].ratio);
      CHECK(x.joints[j].viscous == y.joints[j].viscous);
      CHECK(x.joints[j].coulomb == y.joints[j].coulomb);
    }
    const BodySpec &link = x.body, &other = y.body;
    CHECK(link.name == other.name);
    CHECK(link.mass == other.mass);
    // turned into the file's axes and back
    CHECK((inertia_of(link) - inertia_of(other)).norm() <= 1e-13 * inertia_of(link).norm());
    CHECK((link.shape != nullptr) == (other.shape != nullptr));
    CHECK((link.appearance.visual != nullptr) == (other.appearance.visual != nullptr));
    CHECK(link.appearance.color == other.appearance.color);
    CHECK(link.appearance.triangle_colors == other.appearance.triangle_colors);
  }
}

/// The plan numbers links and chains like the reader of its file.
void check_outline(const RobotSpec& robot, const RobotSpec& read) {
  const RobotSpec outline = outline_of(plan_urdf(robot));
  REQUIRE(outline.links.size() == read.links.size());
  for (size_t l = 0; l < read.links.size(); ++l) {
    CHECK(read.name + "_" + outline.links[l].body.name == read.links[l].body.name);
    CHECK(outline.links[l].parent == read.links[l].parent);
    CHECK(outline.links[l].joints.size() == read.links[l].joints.size());
  }
  const auto ours = chains_of(outline), theirs = chains_of(read);
  REQUIRE(ours.size() == theirs.size());
  for (size_t c = 0; c < ours.size(); ++c) {
    CHECK(ours[c].parent == theirs[c].parent);
    CHECK(ours[c].links == theirs[c].links);
  }
}

/// A robot of one chain with one link, with the given name.
RobotSpec one_link(const std::string& name, const std::string& link_name) {
  RobotSpec robot;
  robot.name = name;
  robot.class_name = "Hand";
  robot.base.name = name + "_base";
  robot.dofs.push_back({.name = link_name + " turns"});
  LinkSpec link;
  link.joints = {{.max = 1}};
  link.X_JL = Pose::translation({0.1, 0, 0});
  link.body.name = name + "_" + link_name;
  link.body.shape = Shape::make(box(0.1, 0.02, 0.03));
  robot.links.push_back(link);
  return robot;
}

std::string contents(const fs::path& path) { return read_bytes(path); }

}  // namespace

TEST_CASE("motors without limits do not stand still in other readers, and come back without") {
  const TemporaryFolder folder;
  const auto urdf = written(one_link("free", "wheel"), folder.path() / "free.urdf");
  CHECK(
      contents(folder.path() / "free.urdf").find("effort=\"1000000000\" velocity=\"1000000000\"") !=
      std::string::npos);
  CHECK(urdf.robot.dofs[0].max_effort == 0);
  CHECK(urdf.robot.dofs[0].max_velocity == 0);
}

TEST_CASE("a robot from a .urdf comes back from one as it was") {
  const TemporaryFolder folder;
  const RobotSpec robot = gripper();
  const auto urdf = written(robot, folder.path() / "other.urdf");
  check_outline(robot, urdf.robot);
  check_same_kinematics(robot, urdf.robot);
  CHECK(largest_gap(robot, urdf.robot) < 1e-15);
  CHECK(urdf.lost.empty());
  CHECK(*urdf.robot.X_BA == *robot.X_BA);
  CHECK(contents(folder.path() / "other.urdf").find("rgba=\"0.5 0.5 0.6 1\"") != std::string::npos);
}

TEST_CASE("a robot of MuJoCo stands in a .urdf as it did, whatever its DOFs") {
  const TemporaryFolder folder;
  const RobotSpec robot = read_robot("tests/data/mjcf/hand.mjcf");
  const auto urdf = written(robot, folder.path() / "hand.urdf");
  check_outline(robot, urdf.robot);
  CHECK(largest_gap(robot, urdf.robot) < 1e-12);
  CHECK(
      urdf.told("hand.urdf: 'thumb_flex_frame' is a frame without mass between two joints of one "
                "link"));
}

static RobotSpec read_hand(const fs::path& file) {
  ReadOptions options;
  options.packages[""] = file.parent_path();
  return read_robot(file, options);
}

static void check_hands(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const fs::path file = shared() / "data/hands-urdf" / name;
    INFO(file.string());
    const RobotSpec robot = read_hand(file);
    const TemporaryFolder folder;
    const auto urdf = written(robot, folder.path() / "hand.urdf");
    check_outline(robot, urdf.robot);
    check_same_kinematics(robot, urdf.robot);
    CHECK(largest_gap(robot, urdf.robot, 3) < 1e-12);
  }
}

TEST_CASE("hands of today come back from a .urdf as they were, trees that begin on the palm") {
  REQUIRE_SHARED();
  check_hands({"allegro_hand/allegro_hand_right.urdf", "leap_hand/leap_hand_right.urdf"});
}

TEST_CASE("hands of today come back from a .urdf as they were, followers and wrists") {
  REQUIRE_SHARED();
  check_hands({"barrett_hand/bhand_model.urdf", "shadow_hand/shadow_hand_right.urdf"});
}

TEST_CASE("a chain may begin on a link that moves") {
  const TemporaryFolder folder;
  RobotSpec robot = one_link("any", "palm2");
  for (const char* name : {"any_tip", "any_nail"}) {
    LinkSpec branch = robot.links[0];
    branch.parent = 0;
    branch.body.name = name;
    robot.links.push_back(branch);
  }
  const auto urdf = written(robot, folder.path() / "hand.urdf");
  check_outline(robot, urdf.robot);
  CHECK(largest_gap(robot, urdf.robot) < 1e-12);
}

TEST_CASE("axes that are nearly parallel leave every frame of a .urdf within the robot") {
  for (const double tilt : {0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5}) {
    CAPTURE(tilt);
    RobotSpec robot = one_link("any", "near");
    for (const char* name : {"any_middle", "any_far"}) {
      LinkSpec link = robot.links.back();
      link.parent = static_cast<int>(robot.links.size()) - 1;
      link.body.name = name;
      link.joints[0].X_PJ =
          Pose::translation({0.01, 0, 0}) * Pose::turn(tilt, Eigen::Vector3d::UnitX());
      robot.links.push_back(link);
    }
    const UrdfPlan plan = plan_urdf(robot);
    for (const UrdfJoint& joint : plan.joints) CHECK(joint.X_PC.position.norm() < 0.2);
    for (const UrdfLink& link : plan.links) CHECK(link.X_UB.position.norm() < 0.2);
    const TemporaryFolder folder;
    CHECK(largest_gap(robot, written(robot, folder.path() / "hand.urdf").robot) < 1e-12);
  }
}

TEST_CASE("names with blanks, quotes and signs of XML come back") {
  const TemporaryFolder folder;
  const std::string name = "a \"b\" <c> & 'd'";
  const RobotSpec robot = one_link(name, name);
  const auto urdf = written(robot, folder.path() / "my hand & <co>.urdf");
  check_outline(robot, urdf.robot);
  CHECK(urdf.robot.name == name);
  CHECK(link_of(urdf.robot, 0, 0).body.name == name + "_" + name);
  CHECK(urdf.robot.dofs[0].name == name + " turns");
}

TEST_CASE("links and joints of one name get others, and a name that readers trim is told") {
  const TemporaryFolder folder;
  RobotSpec robot = one_link("any", "tip ");
  robot.links.push_back(robot.links[0]);
  joint_of(robot, 0, 0).name = joint_of(robot, 1, 0).name = "${x}";
  const auto urdf = written(robot, folder.path() / "hand.urdf");
  check_outline(robot, urdf.robot);
  REQUIRE(urdf.robot.links.size() == 2);
  CHECK(link_of(urdf.robot, 0, 0).body.name == "any_tip");
  CHECK(link_of(urdf.robot, 1, 0).body.name == "any_tip_2");
  CHECK(joint_of(urdf.robot, 0, 0).name == "_{x}");
  CHECK(joint_of(urdf.robot, 1, 0).name == "_{x}_2");
  CHECK(urdf.told("hand.urdf: 'tip ' is called 'tip' in it"));
  CHECK(urdf.told("hand.urdf: 'tip ' is called 'tip_2' in it"));
  CHECK(urdf.told("hand.urdf: '${x}' is called '_{x}_2' in it"));
}

TEST_CASE("leaders keep their DOF's order, opposite and partial ratios their sense") {
  const TemporaryFolder folder;
  // the first chain moves with the second DOF, but only in the opposite direction or with a ratio
  RobotSpec robot = one_link("any", "left");
  robot.dofs.resize(2);
  robot.dofs[0].name = "first", robot.dofs[1].name = "second";
  joint_of(robot, 0, 0).dof = 1;
  joint_of(robot, 0, 0).ratio = -1;
  robot.links.push_back(robot.links[0]);
  link_of(robot, 1, 0).body.name = "any_right";
  joint_of(robot, 1, 0).dof = 0;
  joint_of(robot, 1, 0).ratio = -0.5;
  robot.links.push_back(robot.links[1]);
  link_of(robot, 2, 0).body.name = "any_middle";
  joint_of(robot, 2, 0).ratio = 0.25;
  joint_of(robot, 2, 0).X_PJ = Pose::turn(0.3, Eigen::Vector3d::UnitZ());
  joint_of(robot, 2, 0).min = -1;
  EigengraspSet set = identity_eigengrasps(2);
  set.origin = Eigen::VectorXd::Constant(2, -0.3);
  robot.eigengrasps = set;
  const auto urdf = written(robot, folder.path() / "hand.urdf");
  check_outline(robot, urdf.robot);
  CHECK(urdf.robot.dofs[0].name == "first");
  CHECK(urdf.robot.dofs[1].name == "second");
  CHECK(
      urdf.told("hand.urdf: the values of DOF 0 are multiplied by 0.5 in it, to equal those of its "
                "joint 'first'"));
  // values of a DOF are those of its first joint, in the DOF's direction
  Random random(4, 0);
  for (int k = 0; k < 10; ++k) {
    auto dofs = any_dofs(robot, random);
    const auto a = placed_points(robot, dofs);
    dofs[0] *= 0.5;
    auto b = placed_points(urdf.robot, dofs);
    for (const auto& [name, points] : a)
      for (size_t i = 0; i < points.size(); ++i) CHECK((points[i] - b[name][i]).norm() < 1e-15);
  }
  ReadOptions options;
  options.eigengrasps = (folder.path() / "eigen/hand_urdf.egr").string();
  const auto again = read_robot(folder.path() / "hand.urdf", options);
  REQUIRE(again.eigengrasps);
  CHECK((*again.eigengrasps->origin)[0] == -0.15);
  CHECK((*again.eigengrasps->norm)[0] == 0.5);
  CHECK((*again.eigengrasps->norm)[1] == 1);
}

TEST_CASE("a follower that leaves its leader next to nothing is no slip when it is meant") {
  const TemporaryFolder folder;
  RobotSpec robot = one_link("any", "left");
  robot.links.push_back(robot.links[0]);
  link_of(robot, 1, 0).body.name = "any_right";
  joint_of(robot, 1, 0).max = 0.01;
  const auto urdf = written(robot, folder.path() / "hand.urdf");
  check_outline(robot, urdf.robot);
  CHECK(dof_range(urdf.robot, 0) == dof_range(robot, 0));
}

TEST_CASE("virtual contacts of a .urdf name its own chains and links") {
  const TemporaryFolder folder;
  // in the file, the link that is moved by two joints is the second of its chain
  RobotSpec robot = one_link("any", "tip");
  auto& joints = robot.links[0].joints;
  joints.push_back(joints[0]);
  robot.dofs.emplace_back();
  joints[1].dof = 1;
  joints[1].X_PJ = robot.links[0].X_JL;
  VirtualContactSpec contact;
  contact.link = 0;
  contact.X_LC = Pose::translation({0.01, 0.02, 0.03});
  robot.virtual_contacts = std::vector{contact};
  write_robot(robot, folder.path() / "hand.urdf");
  CHECK(!fs::exists(folder.path() / ".hand.saving.urdf"));
  ReadOptions options;
  options.virtual_contacts = (folder.path() / "virtual/hand_urdf.vgr").string();
  const auto again = read_robot(folder.path() / "hand.urdf", options);
  REQUIRE(again.virtual_contacts);
  const VirtualContactSpec& read = again.virtual_contacts->at(0);
  CHECK(read.link == 1);
  const std::vector<double> dofs = {0.3, 0.4};
  const Eigen::Vector3d at = link_poses(robot, dofs)[0] * contact.X_LC.position;
  CHECK((link_poses(again, dofs)[1] * read.X_LC.position - at).norm() < 1e-12);
}

TEST_CASE("surfaces of several colors keep them beside a .urdf, transparent ones too") {
  const TemporaryFolder folder;
  RobotSpec robot = one_link("any", "tip");
  Appearance& looks = link_of(robot, 0, 0).body.appearance;
  looks.given = true;
  looks.transparency = 0.25f;
  for (int i = 0; i < 12; ++i)
    looks.triangle_colors.push_back(i < 5 ? Eigen::Vector3f(1, 0, 0.3f) : Eigen::Vector3f(0, 1, 0));
  const auto urdf = written(robot, folder.path() / "hand.urdf");
  check_outline(robot, urdf.robot);
  const Appearance& read = link_of(urdf.robot, 0, 0).body.appearance;
  CHECK(read.triangle_colors == looks.triangle_colors);
  CHECK(read.transparency == 0.25f);
  CHECK(!read.visual);
}

TEST_CASE("rolls, pitches and yaws give turns back, a quarter turn of pitch too") {
  const TemporaryFolder folder;
  const double half_turn = std::numbers::pi;
  Random random(5, 5);
  for (int i = 0; i < 40; ++i) {
    RobotSpec robot = one_link("any", "tip");
    Pose& X = joint_of(robot, 0, 0).X_PJ;
    const double pitch = i % 4 == 0   ? half_turn / 2
                         : i % 4 == 1 ? -half_turn / 2 + 1e-9 * i
                                      : random.uniform(-2, 2);
    X = Pose::turn(random.uniform(-3, 3), Eigen::Vector3d::UnitZ()) *
        Pose::turn(pitch, Eigen::Vector3d::UnitY()) *
        Pose::turn(random.uniform(-3, 3), Eigen::Vector3d::UnitX());
    write_robot(robot, folder.path() / "hand.urdf");
    CHECK(largest_gap(robot, read_robot(folder.path() / "hand.urdf"), 1) < 1e-15);
  }
}
