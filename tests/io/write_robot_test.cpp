#include "clench/io/write/write_robot.h"

#include <algorithm>
#include <fstream>
#include <map>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "files_below.h"
#include "robot_compare.h"
#include "support/chains.h"
#include "support/plain_user.h"
#include "support/shapes.h"
#include "support/shared.h"
#include "temporary.h"
#include "written_robot.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

const std::string one_finger = R"(<?xml version="1.0" ?>
<robot type="Hand" DBName="TOY &amp; co">
  <palm>palm.xml</palm>
  <dof type="b"><defaultVelocity>-1.3</defaultVelocity><defaultValue>17.3</defaultValue>
    <maxEffort>5e9</maxEffort><Kp>1e11</Kp><Kd>1e7</Kd><draggerScale>20.7</draggerScale>
    <breakAwayTorque>0.7</breakAwayTorque></dof>
  <dof type="c"><defaultVelocity>31</defaultVelocity><defaultValue>3.7</defaultValue>
    <maxEffort>5.1e6</maxEffort><Kp>1e3</Kp><Kd>1e2</Kd></dof>
  <chain>
    <transform><translation>1.1 2.2 3.3</translation><rotation>33 x</rotation></transform>
    <joint type="Revolute"><theta>d0*-0.7+33.3</theta><d>1.7</d><a>50.1</a><alpha>-90</alpha>
      <minValue>-77.7</minValue><maxValue>99.9</maxValue><viscousFriction>5e7</viscousFriction>
      <CoulombFriction>3e7</CoulombFriction><springStiffness>4.4</springStiffness>
      <restValue>0.13</restValue></joint>
    <joint type="Prismatic"><theta>12.3</theta><d>d1-5.9</d><a>0</a><alpha>7</alpha>
      <minValue>0</minValue><maxValue>30.3</maxValue></joint>
    <joint type="Revolute"><theta>d1*0.01</theta><d>0</d><a>9</a><alpha>0</alpha>
      <minValue>-90</minValue><maxValue>90</maxValue></joint>
    <link dynamicJointType="Universal" collisionRule="Off">link.xml</link>
    <link dynamicJointType="Revolute" collisionRule="OverlappingPair" targetChain="base">link.xml</link>
    <filter params="-1.1,-2,-3,4,5,6.6">1</filter>
  </chain>
  <disableCollision body1_chain="0" body1_link="0" body2_chain="-1" body2_link="0"/>
  <tendon name="a &lt; 'b'"><stiffness>3.3</stiffness><restLength>77.7</restLength>
    <insertionPoint><chain>-1</chain><link>-1</link><position>1.1 2 3</position>
      <friction>0.3</friction></insertionPoint>
    <insertionPoint><chain>0</chain><link>1</link><position>4 5.5 6</position></insertionPoint>
  </tendon>
  <tendonWrapper><chain>0</chain><link>0</link><position>1 2 3.3</position>
    <orientation>1 2 3</orientation><radius>3.3</radius><length>7</length>
    <friction>0.2</friction><exemption tendon="c"/>
    <wrapping_side tendon="a &lt; 'b'"><orientation>0 3 4</orientation></wrapping_side>
  </tendonWrapper>
  <approachDirection><referenceLocation>1 2 3.3</referenceLocation><direction>0 0.3 1</direction>
  </approachDirection>
  <eigenGrasps>eigen.xml</eigenGrasps>
  <virtualContacts>contacts.vgr</virtualContacts>
  <cyberGlove>glove.txt</cyberGlove>
  <flockOfBirds number="3"><transform><translation>1 2.2 3</translation></transform></flockOfBirds>
</robot>
)";

const std::string surface =
    "OFF\n4 4 0\n0 0 0\n10.1 0 0\n0 10.3 0\n0 0 7.7\n"
    "3 0 2 1 1.0 0.0 0.0\n3 0 1 3 0.3 0.7 1.0\n3 1 2 3 1.0 1.0 1.0\n"
    "3 2 0 3 0.1 0.2 0.3\n";

/// All properties that an .xml robot may have.
fs::path full_robot(const TemporaryFolder& folder) {
  folder.write("iv/palm.xml",
               "<root><material>rubber</material><youngs>1.5e6</youngs><mass>7.77</mass>"
               "<cog>1.1 2 3</cog><inertia_matrix>30 1 0 1 20.2 0 0 0 25</inertia_matrix>"
               "<useFlockOfBirds>2</useFlockOfBirds>"
               "<geometryFile type=\"off\">palm.off</geometryFile></root>");
  folder.write("iv/palm.off", surface);
  folder.write("iv/link.xml",
               "<root><mass>33</mass><geometryFile type=\"off\">link.off</geometryFile></root>");
  folder.write("iv/link.off",
               "OFF\n4 4 0\n0 0 0\n30 0 0\n0 10.3 0\n0 0 7.7\n3 0 2 1 1.0 0.5 0.0 0.75\n"
               "3 0 1 3 1.0 0.5 0.0 0.75\n3 1 2 3 1.0 0.5 0.0 0.75\n3 2 0 3 1.0 0.5 0.0 0.75\n");
  folder.write("eigen.xml",
               "<EigenGrasps dimensions=\"2\"><EG><EigenValue value=\"0.3\"/>"
               "<Limits min=\"-1\" max=\"0.7\"/><DimVals d0=\"0.1\" d1=\"1\"/></EG>"
               "<ORIGIN><EigenValue value=\"0\"/><DimVals d0=\"0.3\" d1=\"0.001\"/></ORIGIN>"
               "</EigenGrasps>");
  folder.write("contacts.vgr",
               "hand\n2\n-1 0\n0\n1 2 3.3\n1 0 0 0\n1 2 3.3\n0 0 1\n0.7\n"
               "0 1\n1\n0 1 0 0 0 0.3\n1 2 3\n1 0 0 0\n1 2 3\n0 0 1\n1\n");
  folder.write("glove.txt", "2 3\n0.1 0.2 0.3\n1 2 3\n0.7 0.01\n");
  return folder.write("hand.xml", one_finger);
}

}  // namespace

TEST_CASE("every hand and arm of ours stands in a .urdf as it did, whatever its DOFs") {
  for (const char* kind : {"models/hands", "models/arms"})
    for (const fs::path& file : files_below(kind, {".cfg"})) {
      INFO(file.string());
      const TemporaryFolder folder;
      const RobotSpec robot = read_robot(file);
      ReadOptions reading;
      const fs::path egr = folder.path() / "eigen/hand_urdf.egr",
                     vgr = folder.path() / "virtual/hand_urdf.vgr";
      const auto urdf = written(robot, folder.path() / "hand.urdf");
      REQUIRE(urdf.robot.dofs.size() == robot.dofs.size());
      for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
        const auto a = dof_range(robot, d), b = dof_range(urdf.robot, d);
        // a quotient and a product
        CHECK(a[0] == doctest::Approx(b[0]).epsilon(1e-15));
        CHECK(a[1] == doctest::Approx(b[1]).epsilon(1e-15));
      }
      // the inertia of an arm's link includes that of its motor, which no rigid body can have
      if (std::string(kind) == "models/hands") CHECK(urdf.warnings.empty());
      CHECK(largest_gap(robot, urdf.robot) < 1e-12);
      if (fs::exists(egr)) reading.eigengrasps = egr.string();
      if (fs::exists(vgr)) reading.virtual_contacts = vgr.string();
      CHECK(fs::exists(egr) == robot.eigengrasps.has_value());
      CHECK(fs::exists(vgr) == robot.virtual_contacts.has_value());
      CHECK_NOTHROW(read_robot(folder.path() / "hand.urdf", reading));
    }
}

TEST_CASE("what a .urdf does not hold is told, a sentence each") {
  const TemporaryFolder folder, out;
  const RobotSpec robot = read_robot(full_robot(folder));
  const auto urdf = written(robot, out.path() / "hand.urdf");
  const std::vector<std::string> expected = {
      "hand.urdf: 'chain0_joint0_frame' is a frame without mass between two joints of one link",
      "hand.urdf: the values of DOF 0 are multiplied by 0.7 in it, to equal those of its joint "
      "'chain0_joint0'",
      "hand.urdf: these links have other frames in it, on the axes of their joints: "
      "'chain0_link1'",
      "hand.urdf does not hold the 1 tactile sensors",
      "hand.urdf does not hold the 1 tendons and 1 wrappers"};
  for (const std::string& sentence : expected) {
    INFO(sentence);
    CHECK(urdf.told(sentence));
  }
  for (const std::string& sentence : urdf.lost) {
    INFO(sentence);
    CHECK(std::ranges::count(expected, sentence) == 1);
  }
}

TEST_CASE("what a .urdf says of its own, readers of ours read") {
  const TemporaryFolder folder, out;
  RobotSpec robot = read_robot(full_robot(folder));
  robot.base.soft_layer = 0.004;
  ActuatorSpec a, b;
  a.name = "a & b", a.kind = "motor", a.joint = "j", a.dof = 0;
  a.gear = 3, a.gain = 2, a.bias = {1, 2, 3}, a.control_range = {-1.0, 2.0};
  b.kind = "muscle", b.tendon = "t", b.law_known = false;
  robot.actuators = {a, b};
  joint_of(robot, 0, 0).armature = 0.25;
  const auto urdf = written(robot, out.path() / "hand.urdf");
  CHECK(urdf.warnings.empty());
  const RobotSpec& again = urdf.robot;
  CHECK(again.class_name == robot.class_name);
  CHECK(again.database_name == robot.database_name);
  CHECK(again.base.material == robot.base.material);
  CHECK(again.base.elastic_modulus == robot.base.elastic_modulus);
  CHECK(again.base.soft_layer == 0.004);
  CHECK(again.base.tracker == robot.base.tracker);
  CHECK(*again.X_BA == *robot.X_BA);
  CHECK(again.tracker->number == robot.tracker->number);
  CHECK(again.tracker->X_BS == robot.tracker->X_BS);
  CHECK(again.chain_links_collide == robot.chain_links_collide);
  CHECK(again.collision_rules.near_pairs_off == robot.collision_rules.near_pairs_off);
  CHECK(again.collision_rules.parts_off.size() == robot.collision_rules.parts_off.size());
  REQUIRE(again.dofs.size() == robot.dofs.size());
  // the values of DOF 0 are multiplied by 0.7
  const std::vector<double> scale = {0.7, 1};
  for (size_t d = 0; d < 2; ++d) {
    const DofSpec &was = robot.dofs[d], &is = again.dofs[d];
    CHECK(was.kind == is.kind);
    CHECK(is.default_velocity == doctest::Approx(was.default_velocity * scale[d]));
    CHECK(is.kp == doctest::Approx(was.kp / scale[d] / scale[d]));
    CHECK(is.kd == doctest::Approx(was.kd / scale[d] / scale[d]));
    CHECK(is.breakaway_torque == doctest::Approx(was.breakaway_torque / scale[d]));
    CHECK(is.dragger_scale == was.dragger_scale);
    CHECK(is.default_value == doctest::Approx(was.default_value * scale[d]));
  }
  CHECK(joint_of(again, 0, 0).armature == 0.25);
  CHECK(joint_of(again, 0, 0).spring == joint_of(robot, 0, 0).spring);
  REQUIRE(again.eigengrasps);
  CHECK(again.eigengrasps->grasps.size() == robot.eigengrasps->grasps.size());
  REQUIRE(again.virtual_contacts);
  CHECK(again.virtual_contacts->size() == robot.virtual_contacts->size());
  REQUIRE(again.glove);
  REQUIRE(again.actuators.size() == 2);
  const ActuatorSpec &motor = again.actuators[0], &muscle = again.actuators[1];
  CHECK(motor.name == "a & b");
  CHECK(motor.joint == "j");
  CHECK(motor.dof == 0);
  CHECK(motor.gear == 3);
  CHECK(motor.gain == 2);
  CHECK(motor.bias == std::array{1.0, 2.0, 3.0});
  CHECK(motor.control_range == std::array{-1.0, 2.0});
  CHECK(!motor.force_range);
  CHECK(muscle.kind == "muscle");
  CHECK(!muscle.law_known);
}

/// Every third file of GraspIt!'s robots, from number `first`, with the robot read from it.
static std::vector<std::pair<fs::path, RobotSpec>> robots_of_the_original(size_t first) {
  std::vector<std::pair<fs::path, RobotSpec>> out;
  auto files = files_below(shared() / "data/graspit/models/robots", {".cfg"});
  for (const fs::path& file : files_below(shared() / "data/graspit-xml/models/robots", {".xml"}))
    files.push_back(file);
  for (size_t i = first; i < files.size(); i += 3) {
    try {
      out.emplace_back(files[i], read_robot(files[i]));
    } catch (const Error&) {
      // bodies, eigengrasps and contacts, and invalid files
    }
  }
  return out;
}

TEST_CASE("robots of the original stand in a .urdf as they did") {
  REQUIRE_SHARED();
  for (const auto& [file, robot] : robots_of_the_original(1)) {
    INFO(file.string());
    const TemporaryFolder out;
    const auto urdf = written(robot, out.path() / "hand.urdf");
    // DOFs that move no joint are lost, and some have other values in the file
    const bool same = std::ranges::none_of(urdf.lost, [](const std::string& sentence) {
      return sentence.find("moves no joint") != std::string::npos ||
             sentence.find("are multiplied by") != std::string::npos;
    });
    if (same) CHECK(largest_gap(robot, urdf.robot, 3) < 1e-12);
  }
}

namespace {

/// A hand of one link, without surfaces.
RobotSpec bare_hand() {
  RobotSpec robot;
  robot.name = "any";
  robot.class_name = "Hand";
  robot.base.name = "any_base";
  robot.dofs.resize(1);
  LinkSpec link;
  link.joints = {{.max = 1}};
  link.body.name = "any_chain0_link0";
  robot.links.push_back(link);
  return robot;
}

void check_refused(const RobotSpec& robot, const std::string& name, const std::string& sentence) {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(write_robot(robot, folder.path() / name), sentence.c_str(), Error);
  CHECK(fs::is_empty(folder.path()));
}

std::map<std::string, std::string> contents_below(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    out[entry.path().string()] = entry.is_regular_file() ? read_bytes(entry.path()) : "";
  return out;
}

}  // namespace

TEST_CASE("a base and links without surfaces come back as frames") {
  const TemporaryFolder folder;
  const RobotSpec robot = bare_hand();
  const auto again = written(robot, folder.path() / "any.urdf");
  CHECK(!again.robot.base.shape);
  CHECK(!link_of(again.robot, 0, 0).body.shape);
  CHECK(again.robot.base.mass == robot.base.mass);
}

TEST_CASE("robots that cannot be written are refused in one sentence, and leave nothing behind") {
  RobotSpec robot = bare_hand();
  check_refused(robot, "hand.sdf", "hand.sdf: expected a robot to .urdf, got '.sdf'");
  check_refused(robot, "hand.cfg", "hand.cfg: expected a robot to .urdf, got '.cfg'");
  robot.base.mass = 0;
  check_refused(robot, "hand.urdf",
                "hand.urdf cannot be written: any: base 'any_base': mass: expected a number from "
                "1e-12 to 1e+12 [kg], got 0");
  robot = bare_hand();
  joint_of(robot, 0, 0).max = -1;
  check_refused(robot, "hand.urdf",
                "hand.urdf cannot be written: any: link 'any_chain0_link0': joint 0: min 0 exceeds "
                "max -1 [rad]");
  robot = bare_hand();
  robot.dofs[0].max_effort = HUGE_VAL;
  check_refused(robot, "hand.urdf",
                "hand.urdf cannot be written: any: DOF 0: max effort: expected a number from 0 to "
                "1e+30, got inf");
  robot = bare_hand();
  JointSpec far = joint_of(robot, 0, 0);
  far.X_PJ = Pose::translation({8e8, 8e8, 0});
  LinkSpec& middle = robot.links[0];
  middle.X_JL = far.X_PJ;
  LinkSpec tip = middle;
  tip.body.name = "any_tip";
  tip.parent = 0;
  tip.joints.assign(1, far);
  robot.links.push_back(tip);
  check_refused(
      robot, "hand.urdf",
      "hand.urdf: joint 'chain0_joint1': expected a position within 1e+09 m of the origin, got "
      "(1600000000, 1600000000, 0)");
}

TEST_CASE("a robot whose file cannot be written keeps the older one") {
  const TemporaryFolder folder;
  RobotSpec robot = bare_hand();
  const fs::path absent = folder.path() / "absent/hand.urdf";
  CHECK_THROWS_WITH_AS(write_robot(robot, absent),
                       fmt::format("{}: the file cannot be written: no such folder: {}",
                                   absent.string(), absent.parent_path().string())
                           .c_str(),
                       Error);
  fs::create_directory(folder.path() / "folder.urdf");
  CHECK_THROWS_WITH_AS(write_robot(robot, folder.path() / "folder.urdf"),
                       fmt::format("{}: expected a file to write, got a folder",
                                   (folder.path() / "folder.urdf").string())
                           .c_str(),
                       Error);
  // a file in place of the folder of the links
  robot.base.shape = Shape::make(box(1, 1, 1));
  folder.write("hand_files", "");
  const fs::path older = folder.write("hand.urdf", "older");
  CHECK_THROWS_AS(write_robot(robot, older), Error);
  CHECK(read_bytes(older) == "older");
  CHECK(contents_below(folder.path()).size() == 3);
}

TEST_CASE("of a robot that cannot be written whole no part is, and older parts stay") {
  const TemporaryFolder folder;
  RobotSpec robot = bare_hand();
  robot.base.shape = Shape::make(box(1, 1, 1));
  fs::permissions(folder.path(), fs::perms(0777));
  const fs::path file = folder.path() / "hand.urdf";
  write_robot(robot, file);
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    fs::permissions(entry, entry.is_directory() ? fs::perms(0777) : fs::perms(0666));
  fs::permissions(file, fs::perms(0444));
  const auto before = contents_below(folder.path());
  robot.base.shape = Shape::make(box(2, 1, 1));
  link_of(robot, 0, 0).body.shape = Shape::make(box(3, 1, 1));
  {
    const test::PlainUser user;
    CHECK_THROWS_WITH_AS(
        write_robot(robot, file),
        (file.string() + ": the file cannot be written: Permission denied").c_str(), Error);
  }
  CHECK(contents_below(folder.path()) == before);
}

TEST_CASE("a DOF without joints has no place in a .urdf, nor has what counts it") {
  const TemporaryFolder folder;
  RobotSpec robot = bare_hand();
  robot.dofs.resize(2);
  robot.eigengrasps = identity_eigengrasps(2);
  robot.glove = GloveCalibration{Eigen::MatrixXd::Ones(2, 3), Eigen::VectorXd::Ones(2)};
  const auto urdf = written(robot, folder.path() / "any.urdf");
  CHECK(urdf.robot.dofs.size() == 1);
  for (const char* sentence :
       {"any.urdf does not hold DOF 1, which moves no joint",
        "any.urdf does not hold the eigengrasps: they count a DOF that moves no joint",
        "any.urdf does not hold the calibration of a glove: they count a DOF that moves no joint"})
    CHECK(urdf.told(sentence));
  CHECK(!fs::exists(folder.path() / "eigen"));
}

TEST_CASE("robots of one name, or of names alike, that are written into one folder share no file") {
  const TemporaryFolder folder;
  const auto of_size = [](double size) {
    RobotSpec robot = bare_hand();
    robot.base.shape = Shape::make(box(size, size, size));
    return robot;
  };
  const std::vector<std::string> files = {"any.urdf", "any hand.urdf", "any_hand.urdf"};
  for (size_t i = 0; i < files.size(); ++i)
    write_robot(of_size(1.0 + static_cast<double>(i)), folder.path() / files[i]);
  for (size_t i = 0; i < files.size(); ++i) {
    INFO(files[i]);
    const RobotSpec again = read_robot(folder.path() / files[i]);
    CHECK(again.base.shape->bounds().size().x() == 1.0 + static_cast<double>(i));
  }
}

TEST_CASE("parts that are equal share their files, and others of one name have their own") {
  const TemporaryFolder folder;
  RobotSpec robot = bare_hand();
  LinkSpec link = link_of(robot, 0, 0);
  link.body.shape = Shape::make(box(1, 1, 1));
  link.body.file = "/elsewhere/link.iv";
  robot.links.assign(3, link);
  robot.links[2].body.shape = Shape::make(box(2, 1, 1));
  write_robot(robot, folder.path() / "any.urdf");
  for (const char* name : {"link.obj", "link_2.obj"})
    CHECK(fs::exists(folder.path() / "any_files" / name));
  CHECK(!fs::exists(folder.path() / "any_files/link_3.obj"));
}

TEST_CASE("colors beyond what files hold do not make a robot unreadable") {
  const TemporaryFolder folder;
  RobotSpec robot = bare_hand();
  robot.base.shape = Shape::make(box(1, 1, 1));
  Appearance& looks = robot.base.appearance;
  looks.given = true;
  looks.color = {2, -1, std::nanf("")};
  looks.transparency = 3;
  const auto again = written(robot, folder.path() / "any.urdf");
  CHECK(again.robot.base.appearance.color == Eigen::Vector3f(1, 0, 0));
  CHECK(again.robot.base.appearance.transparency == 1);
}
