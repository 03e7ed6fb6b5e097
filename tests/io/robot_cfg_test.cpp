#include <numbers>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "support/chains.h"
#include "support/listening.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using clench::test::joint_of;
using clench::test::link_of;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

static constexpr double one_degree = std::numbers::pi / 180;

/// A robot of one chain, with given joint lines and given text before and after them.
struct Cfg {
  std::string class_line = "Hand\n";
  std::string dofs = "1\nr 1.5 5e9 1e9 1e7 20\n";
  std::string transforms = "t 0 0 0\n";
  std::string joints = "1\n1\n", joint_lines = "d0 0 10 0 -10 90\n";
  std::string links = "Revolute\nbox.iv 0\n";
  std::string rest;

  RobotSpec read(const ReadOptions& options = {}) const {
    const TemporaryFolder folder;
    folder.write("iv/box.iv",
                 "#Inventor V2.1 ascii\n#mass 20\nCube { width 20 height 20 depth 20 }\n");
    folder.write("eigen/a.egr", "DIMENSIONS 1\nEG\n1\n1\n");
    return read_robot(
        folder.write("hand.cfg", "#class\n" + class_line + "box.iv\n" + dofs + "1\n" + joints +
                                     transforms + joint_lines + links + rest),
        options);
  }
};

TEST_CASE("the two-finger pincher is read as it is written") {
  const RobotSpec r = read_robot("tests/data/two_finger/pincher.cfg");
  CHECK(r.name == "pincher");
  CHECK(r.class_name == "Hand");
  CHECK(r.base.name == "pincher_base");
  CHECK(r.base.mass == doctest::Approx(0.5));
  REQUIRE(r.dofs.size() == 2);
  REQUIRE(r.links.size() == 2);
  CHECK(link_of(r, 1, 0).body.name == "pincher_chain1_link0");
  for (const LinkSpec& link : r.links) {  // the file omits the last joint of the second link
    CHECK(link.parent == -1);
    CHECK(link.joints.size() == 1);
  }
  const JointSpec& joint = joint_of(r, 0, 0);
  CHECK(joint.kind == JointKind::prismatic);
  CHECK(joint.max == doctest::Approx(0.044));
  // a sliding DOF: mm/s, g mm/s^2
  CHECK(r.dofs[0].default_velocity == doctest::Approx(0.01));
  CHECK(r.dofs[0].max_effort == doctest::Approx(20));
  CHECK(r.dofs[0].kp == doctest::Approx(1000));
  CHECK(r.dofs[0].kd == doctest::Approx(10));
  REQUIRE(r.X_BA);
  CHECK(r.X_BA->angle() < 1e-15);
  CHECK_FALSE(r.tracker);
}

TEST_CASE("a geometry file that several links name is read once and shared") {
  const RobotSpec r = read_robot("tests/data/two_finger/claw.cfg");
  CHECK(link_of(r, 0, 0).body.shape == link_of(r, 1, 0).body.shape);
  CHECK(link_of(r, 0, 0).body.shape != link_of(r, 0, 1).body.shape);
}

TEST_CASE("numbers of a turning joint come in radians, newton meters and meters") {
  Cfg cfg;
  cfg.dofs = "1\nb 1.5 5e9 1e9 1e7 20 0.5\n";
  cfg.joint_lines = "d0*-0.5+90 7 10 -90 -10 90 5e7 2e6 1600 0.25\n";
  const RobotSpec r = cfg.read();
  const JointSpec& j = joint_of(r, 0, 0);
  CHECK(j.kind == JointKind::revolute);
  CHECK(j.ratio == -0.5);
  // theta 90, d 7, a 10, alpha -90
  const Pose& X_JL = link_of(r, 0, 0).X_JL;
  CHECK((X_JL.position - Eigen::Vector3d(0, 0.010, 0.007)).norm() < 1e-15);
  CHECK((X_JL.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK((X_JL.rotation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitX()).norm() < 1e-15);
  CHECK(j.min == doctest::Approx(-10 * one_degree));
  CHECK(j.max == doctest::Approx(90 * one_degree));
  CHECK(j.viscous == doctest::Approx(0.05));
  CHECK(j.coulomb == doctest::Approx(0.002));
  CHECK(j.spring == doctest::Approx(1.6));
  CHECK(j.rest == 0.25);
  const DofSpec& d = r.dofs[0];
  CHECK(d.kind == DofKind::breakaway);
  CHECK(d.default_velocity == 1.5);
  CHECK(d.max_effort == doctest::Approx(5));
  CHECK(d.kp == doctest::Approx(1));
  CHECK(d.kd == doctest::Approx(0.01));
  CHECK(d.dragger_scale == doctest::Approx(0.02));
  CHECK(d.breakaway_torque == 0.5);
}

TEST_CASE("a sliding joint stands in the d column, its numbers in millimeters") {
  Cfg cfg;
  cfg.joint_lines = "30 d0*2+-5 10 0 -10 90 5e7 2e6 3 0.5\n";
  const RobotSpec r = cfg.read();
  const JointSpec& j = joint_of(r, 0, 0);
  CHECK(j.kind == JointKind::prismatic);
  const Pose& X_JL = link_of(r, 0, 0).X_JL;
  CHECK(X_JL.angle() == doctest::Approx(30 * one_degree));
  CHECK(X_JL.position.z() == doctest::Approx(-0.005));
  CHECK(j.ratio == 2);
  CHECK(j.min == doctest::Approx(-0.010));
  CHECK(j.viscous == doctest::Approx(5e4));
  CHECK(j.coulomb == doctest::Approx(2));
  CHECK(j.spring == doctest::Approx(3000));
  CHECK(j.rest == doctest::Approx(0.0005));
}

TEST_CASE("a DOF that turns and slides joints counts in the unit of its first") {
  Cfg cfg;
  cfg.joints = "2\n1\n";
  cfg.links = "Universal\nbox.iv 1\n";
  cfg.joint_lines = "d0 0 10 0 -10 90\n0 d0*5 0 0 -100 100\n";
  CHECK(joint_of(cfg.read(), 0, 1).ratio == doctest::Approx(0.005));  // 5 mm per radian
  cfg.joint_lines = "0 d0 10 0 -10 90\nd0*0.1 0 0 0 -1000 1000\n";
  CHECK(joint_of(cfg.read(), 0, 1).ratio == doctest::Approx(100));  // 0.1 rad per millimeter
}

TEST_CASE("a DOF that is told to close slides at 5 cm/s, whatever the ratio of its joints") {
  Cfg cfg;
  cfg.dofs = "1\nr 0 5e9 1e9 1e7 20\n";
  ReadOptions options;
  options.closing = {{"1", -1}};
  for (const char* expression : {"d0", "d0*2", "d0*-1"}) {
    INFO(expression);
    cfg.joint_lines = fmt::format("0 {} 10 0 -10 90\n", expression);
    CHECK(cfg.read(options).dofs[0].default_velocity == -0.05);
    cfg.joint_lines = fmt::format("{} 0 10 0 -10 90\n", expression);
    CHECK(cfg.read(options).dofs[0].default_velocity == -1);
  }
}

TEST_CASE("comments, tabs, blank lines and other line ends change nothing") {
  Cfg cfg;
  cfg.joint_lines = "# theta d\n\n  \t\n d0+90 \t0\t10\t-90 +0 +180 # friction\r\n\r\n";
  const RobotSpec r = cfg.read();
  CHECK(joint_of(r, 0, 0).max == doctest::Approx(180 * one_degree));
  CHECK(joint_of(r, 0, 0).viscous == 0);
}

TEST_CASE("surplus words are not used, with a warning, and comments are none") {
  Cfg cfg;
  cfg.dofs = "1 # DOF\nr 1.5 5e9 1e9 1e7 20 0.5\n";
  cfg.transforms = "t 0 0 0 9 9\nT (1 0 0 0)[0 0 0] # here\nr 0 z # and 9 there\n";
  cfg.joint_lines = "d0 0 10 0 -10 90 0 0 0 0 7\n";
  cfg.links = "Revolute # it turns\nbox.iv 0 plastic\n";
  Warnings warnings;
  CHECK(cfg.read(warnings.options()).links.size() == 1);
  CHECK(warnings.list == std::vector<std::string>{
                             "hand.cfg:5: 1 surplus word is not used",
                             "hand.cfg:9: 2 surplus words are not used",
                             "hand.cfg:12: 1 surplus word is not used",
                             "hand.cfg:14: 1 surplus word is not used",
                         });
}

TEST_CASE("a class that is none and words behind it are told, and change nothing") {
  Cfg cfg;
  Warnings warnings;
  cfg.class_line = "Puma560 # an arm\n";
  cfg.read(warnings.options());
  CHECK(warnings.list.empty());
  cfg.class_line = "Hnad 3 4\n";
  CHECK(cfg.read(warnings.options()).class_name == "Hnad");
  CHECK(warnings.list ==
        std::vector<std::string>{
            "hand.cfg:2: robot: unknown type 'Hnad' has no meaning; did you mean 'Hand'?",
            "hand.cfg:2: 2 surplus words are not used"});
}

TEST_CASE("links without a last joint take the next one, which a note says") {
  Cfg cfg;
  cfg.joints = "3\n2\n";
  cfg.joint_lines = "d0 0 10 0 -10 90\nd0 0 10 0 -10 90\nd0 0 10 0 -10 90\n";
  cfg.links = "Universal\nbox.iv 1\nRevolute\nbox.iv\n";
  std::vector<std::string> notes;
  ReadOptions options;
  options.diagnostics = test::Listening{.note = [&](const std::string& s) { notes.push_back(s); }};
  const auto links = cfg.read(options).links;
  CHECK(notes.at(0) == "hand.cfg:16: link 1: its last joint is not given; joint 2 moves it");
  CHECK(links[0].joints.size() == 2);
  CHECK(links[1].joints.size() == 1);
  CHECK(links[1].parent == 0);
}

TEST_CASE("limits of more than four turns are suspicious") {
  Cfg cfg;
  cfg.joint_lines = "d0 0 10 0 -10 1e30\n";
  Warnings warnings;
  cfg.read(warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"hand.cfg: joints that turn more than four times: '0 of chain 0': "
                                 "is the unit of their limits right?"});
}

TEST_CASE("every kind of link joint is known") {
  Cfg cfg;
  for (const std::string word : {"Revolute", "Prismatic", "Universal", "Ball", "Fixed"}) {
    cfg.links = word + "\nbox.iv -1\n";
    Warnings warnings;
    CHECK(cfg.read(warnings.options()).links[0].joints.empty());
    CHECK(warnings.list ==
          std::vector<std::string>{
              "hand.cfg:9: chain 0: joints from 0 on move no link, and are not used"});
  }
}

TEST_CASE("a link moves with what moves the link before it") {
  Cfg cfg;
  cfg.joints = "2\n2\n";
  cfg.joint_lines = "d0 0 10 0 -10 90\nd0 0 10 0 -10 90\n";
  cfg.links = "Universal\nbox.iv 1\nRevolute\nbox.iv 0\n";
  CHECK_THROWS_WITH_AS(
      cfg.read(), "hand.cfg:15: link 1: last joint: expected a whole number from 1 to 1, got 0",
      Error);
}

TEST_CASE("blocks at the end may come in any order") {
  Cfg cfg;
  cfg.rest =
      "Approach\n10 20 30\n0 1 0\nFlockOfBirds\n3\nt 0 0 10\nr 90 z\nEigenGrasps\neigen/a.egr\n";
  Warnings warnings;
  const RobotSpec r = cfg.read(warnings.options());
  REQUIRE(r.X_BA);
  CHECK((r.X_BA->position - Eigen::Vector3d(0.01, 0.02, 0.03)).norm() < 1e-15);
  CHECK((r.X_BA->matrix().col(2) - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  REQUIRE(r.tracker);
  CHECK(r.tracker->number == 3);
  CHECK(r.tracker->X_BS.position.z() == doctest::Approx(0.01));
  CHECK(r.tracker->X_BS.angle() == doctest::Approx(90 * one_degree));
  CHECK(r.files.eigengrasps.ends_with("eigen/a.egr"));
  CHECK(warnings.list.empty());
}

TEST_CASE(
    "what a robot file names and is not there, and what it says and is not known, are warnings") {
  Cfg cfg;
  cfg.rest =
      "EigenGrasps\neigen/b.egr\nVirtualContacts\nnone.vgr\nCyberGlov\nFlockOfBirds\nt 0 0 1\n";
  Warnings warnings;
  ReadOptions options = warnings.options();
  std::vector<std::string> notes;
  options.diagnostics =
      test::Listening{.warn = [before = options.diagnostics](
                                  const std::string& text) { before.warn(Diagnostic(text)); },
                      .note = [&](const std::string& sentence) { notes.push_back(sentence); }};
  const RobotSpec r = cfg.read(options);
  REQUIRE(notes.size() == 4);
  CHECK(notes[2] ==
        "hand.cfg: no inertia is given; that of a uniform solid is assumed: 'hand_base', "
        "'hand_chain0_link0'");
  CHECK(notes[3] ==
        "hand.cfg: no approach direction is given; it is the z axis of its base, from its origin");
  CHECK(notes[0] == "hand.cfg:19: FlockOfBirds: no bird number, 0 is used");
  CHECK(notes[1] ==
        "hand.cfg: no material is given; wood is assumed: 'hand_base', 'hand_chain0_link0'");
  CHECK(r.files.eigengrasps.empty());
  CHECK(r.files.virtual_contacts.empty());
  CHECK(r.tracker->number == 0);
  CHECK(warnings.list ==
        std::vector<std::string>{
            "hand.cfg:17: unknown keyword 'CyberGlov' is not used; did you mean 'CyberGlove'?",
            "hand.cfg:14: EigenGrasps: no such file: eigen/b.egr; did you mean 'a.egr'?",
            "hand.cfg:16: VirtualContacts: no such file: none.vgr"});
}

TEST_CASE("a DOF that moves nothing is a warning") {
  Cfg cfg;
  cfg.dofs = "2\nr 1.5 5e9 1e9 1e7 20\nr 1.5 5e9 1e9 1e7 20\n";
  Warnings warnings;
  CHECK(cfg.read(warnings.options()).dofs.size() == 2);
  CHECK(warnings.list == std::vector<std::string>{"hand.cfg:6: DOF 1 moves no joint"});
}

TEST_CASE("the Barrett hand of the original has the figures of its manual") {
  REQUIRE_SHARED();
  const RobotSpec r = read_robot(test::shared() / "data/graspit/models/robots/Barrett/Barrett.cfg");
  CHECK(r.class_name == "Barrett");
  REQUIRE(r.dofs.size() == 4);
  CHECK(r.dofs[0].kind == DofKind::rigid);
  CHECK(r.dofs[0].default_velocity == 0);
  CHECK(r.dofs[3].kind == DofKind::breakaway);
  CHECK(r.dofs[3].max_effort == doctest::Approx(5));
  CHECK(r.dofs[3].breakaway_torque == 0.5);
  REQUIRE(chains_of(r).size() == 3);
  CHECK(joint_of(r, 0, 2).ratio == 0.333333333);
  CHECK(dof_range(r, 0)[1] == doctest::Approx(180 * one_degree));
  CHECK(dof_range(r, 1)[1] == doctest::Approx(144 * one_degree));
  CHECK(r.files.virtual_contacts.ends_with("virtual/all_16_contacts.vgr"));
  CHECK(r.tracker->number == 1);
}
