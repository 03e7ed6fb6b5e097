#include <numbers>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "support/chains.h"
#include "support/listening.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

static constexpr double degree = std::numbers::pi / 180;

/// A robot with the given elements, and a box as its palm.
static RobotSpec read_xml_robot(const std::string& inside, const ReadOptions& options = {},
                                const std::string& head = "type=\"Barrett\" DBName=\"Thing\"") {
  const TemporaryFolder folder;
  folder.write("iv/box.iv", "#Inventor V2.1 ascii\nCube { width 20 height 20 depth 20 }\n");
  folder.write("iv/part.xml", "<root><mass>20</mass><geometryFile>box.iv</geometryFile></root>");
  return read_robot(folder.write("hand.xml", "<robot " + head + ">\n<palm>part.xml</palm>\n" +
                                                 inside + "</robot>\n"),
                    options);
}

static std::string dof(const std::string& type = "r", const std::string& more = "") {
  return "<dof type=\"" + type +
         "\"><defaultVelocity>1.5</defaultVelocity><maxEffort>5e9</maxEffort><Kp>1e11</Kp><Kd>1e7</"
         "Kd><draggerScale>20</draggerScale>" +
         more + "</dof>\n";
}
static std::string joint(const std::string& theta, const std::string& d = "0",
                         const std::string& limits = "-10 90", const std::string& more = "") {
  const bool turns = theta.find('d') != std::string::npos;
  const size_t gap = limits.find(' ');
  return std::string("<joint type=\"") + (turns ? "Revolute" : "Prismatic") + "\"><theta>" + theta +
         "</theta><d>" + d + "</d><a>50</a><alpha>-90</alpha><minValue>" + limits.substr(0, gap) +
         "</minValue><maxValue>" + limits.substr(gap + 1) + "</maxValue>" + more + "</joint>\n";
}
static std::string link_of(const std::string& type, const std::string& more = "") {
  return "<link dynamicJointType=\"" + type + "\"" + more + ">box.iv</link>\n";
}
static std::string chain(const std::string& inside) { return "<chain>\n" + inside + "</chain>\n"; }

TEST_CASE("a robot's elements are read in SI") {
  const RobotSpec r = read_xml_robot(
      dof() + dof("b", "<breakAwayTorque>0.5</breakAwayTorque><defaultValue>30</defaultValue>") +
      chain("<transform><translation>25 0 -1</translation><rotation>180 y</rotation></transform>" +
            joint("d0+90", "3", "-10 90",
                  "<viscousFriction>5e7</viscousFriction><CoulombFriction>2e6</CoulombFriction>"
                  "<springStiffness>1600</springStiffness><restValue>1.2</restValue>") +
            joint("d1*0.5+-5") + link_of("Revolute") + link_of("Revolute")) +
      "<approachDirection><referenceLocation>0 0 20</referenceLocation><direction>0 0 "
      "2</direction></approachDirection><flockOfBirds number=\"3\"><transform><translation>0 -60 "
      "-35</translation></transform></flockOfBirds>");
  CHECK(r.name == "hand");
  CHECK(r.class_name == "Barrett");
  CHECK(r.database_name == "Thing");
  CHECK(r.base.name == "hand_base");
  CHECK(r.base.mass == doctest::Approx(0.02));
  REQUIRE(r.dofs.size() == 2);
  CHECK(r.dofs[0].default_velocity == 1.5);
  CHECK(r.dofs[0].max_effort == doctest::Approx(5));
  CHECK(r.dofs[0].kp == doctest::Approx(100));
  CHECK(r.dofs[0].dragger_scale == doctest::Approx(0.02));
  CHECK(r.dofs[1].kind == DofKind::breakaway);
  CHECK(r.dofs[1].breakaway_torque == 0.5);
  CHECK(r.dofs[1].default_value == doctest::Approx(30 * degree));
  const JointSpec& j = test::joint_of(r, 0, 0);
  CHECK((j.X_PJ * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0.025, 0, -1.001)).norm() < 1e-12);
  // theta 90, d 3, a 50, alpha -90
  const Pose& X_JL = test::link_of(r, 0, 0).X_JL;
  CHECK((X_JL.position - Eigen::Vector3d(0, 0.05, 0.003)).norm() < 1e-15);
  CHECK((X_JL.rotation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitX()).norm() < 1e-15);
  CHECK(j.max == doctest::Approx(90 * degree));
  CHECK(j.viscous == doctest::Approx(0.05));
  CHECK(j.coulomb == doctest::Approx(0.002));
  CHECK(j.spring == doctest::Approx(1.6));
  CHECK(j.rest == 1.2);
  CHECK(test::joint_of(r, 0, 1).ratio == 0.5);
  const Eigen::Vector3d x = test::link_of(r, 0, 1).X_JL.rotation * Eigen::Vector3d::UnitX();
  CHECK(std::atan2(x.y(), x.x()) == doctest::Approx(-5 * degree));
  CHECK(test::link_of(r, 0, 1).body.name == "hand_chain0_link1");
  CHECK(test::link_of(r, 0, 1).joints.size() == 1);
  CHECK((r.X_BA->position - Eigen::Vector3d(0, 0, 0.02)).norm() < 1e-15);
  CHECK(r.tracker->number == 3);
  CHECK(r.tracker->X_BS.position.y() == doctest::Approx(-0.06));
}

TEST_CASE("a text robot and an XML robot that say the same are the same") {
  const TemporaryFolder folder;
  folder.write("iv/box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  const RobotSpec text = read_robot(folder.write(
      "hand.cfg",
      "Hand\nbox.iv\n2\nr 1.5 5e9 1e11 1e7 20\nr 1.5 5e9 1e11 1e7 20\n1\n2\n2\nt 1 2 3\nr 40 "
      "x\nd0*-1+90 0 50 -90 -10 90\n30 d1*2 50 -90 -10 90\nRevolute\nbox.iv\nPrismatic\nbox.iv\n"));
  const RobotSpec xml = read_xml_robot(
      dof() + dof() +
      chain("<transform><translation>1 2 3</translation><rotation>40 x</rotation></transform>" +
            joint("d0*-1+90") + joint("30", "d1*2") + link_of("Revolute") + link_of("Prismatic")));
  REQUIRE(xml.links.size() == 2);
  for (int i = 0; i < 2; ++i) {
    const JointSpec &a = test::joint_of(text, 0, i), &b = test::joint_of(xml, 0, i);
    CHECK(a.kind == b.kind);
    CHECK(std::tie(a.dof, a.ratio, a.X_PJ, a.min, a.max) ==
          std::tie(b.dof, b.ratio, b.X_PJ, b.min, b.max));
    CHECK(text.dofs[i].max_effort == xml.dofs[i].max_effort);
    CHECK(text.dofs[i].kp == xml.dofs[i].kp);
    CHECK(text.links[i].X_JL == xml.links[i].X_JL);
  }
}

TEST_CASE("each kind of link takes as many joints as it has") {
  const RobotSpec r =
      read_xml_robot(dof() + chain(joint("d0") + joint("d0") + joint("d0") + joint("d0") +
                                   joint("d0") + joint("0", "d0") + joint("d0") + link_of("Fixed") +
                                   link_of("Universal") + link_of("Ball") + link_of("Prismatic") +
                                   link_of("Fixed") + link_of("Revolute")));
  const size_t joints[] = {0, 2, 3, 1, 0, 1};
  for (int i = 0; i < 6; ++i) {
    CHECK(r.links[i].parent == i - 1);
    CHECK(r.links[i].joints.size() == joints[i]);
  }
}

TEST_CASE("limits written in the DOF's direction are exchanged, with a warning") {
  Warnings warnings;
  const RobotSpec r = read_xml_robot(
      dof() + chain(joint("0", "d0*-10", "-0 -20") + link_of("Prismatic")), warnings.options());
  CHECK(test::joint_of(r, 0, 0).min == doctest::Approx(-0.02));
  CHECK(test::joint_of(r, 0, 0).max == 0);
  CHECK(dof_range(r, 0)[1] == doctest::Approx(0.002));
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0] ==
        "hand.xml:5: joint 0: minValue 0 exceeds maxValue -20; they are exchanged");
}

TEST_CASE(
    "a default value beyond the range is brought to the limit, with a warning if it was given") {
  Warnings warnings;
  const RobotSpec r =
      read_xml_robot(dof("r", "<defaultValue>120</defaultValue>") + dof() +
                         chain(joint("d0") + joint("d1", "0", "10 20") + link_of("Universal")),
                     warnings.options());
  CHECK(r.dofs[0].default_value == doctest::Approx(90 * degree));
  CHECK(r.dofs[1].default_value == doctest::Approx(10 * degree));
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0] ==
        "hand.xml:3: DOF 0: defaultValue 120 is outside its range; moved to the limit");
}

TEST_CASE("collision rules name links, the base, or all") {
  const RobotSpec r = read_xml_robot(
      dof() +
      chain(joint("d0") + joint("d0") + joint("d0") +
            link_of("Revolute", " collisionRule=\"Off\"") +
            link_of("Revolute", " collisionRule=\"OverlappingPair\" targetChain=\"base\"") +
            link_of("Revolute",
                    " collisionRule=\"OverlappingPair\" targetChain=\"0\" targetLink=\"0\"")) +
      "<disableCollision body1_chain=\"0\" body1_link=\"1\" body2_chain=\"-1\" "
      "body2_link=\"0\"/>");
  const CollisionRules& rules = r.collision_rules;
  CHECK(rules.near_pairs_off);
  REQUIRE(rules.parts_off.size() == 1);
  CHECK(rules.parts_off[0] == 0);
  REQUIRE(rules.pairs_off.size() == 3);
  CHECK(rules.pairs_off[0] == std::array{1, -1});
  CHECK(rules.pairs_off[1] == std::array{2, 0});
  CHECK(rules.pairs_off[2] == std::array{1, -1});
}

TEST_CASE("tendons, wrappers and tactile sensors are kept, and one warning says they do not act") {
  Warnings warnings;
  const RobotSpec r = read_xml_robot(
      dof() +
          chain(joint("d0") + link_of("Revolute") + "<filter params=\"0,1,2,3,4,5\">0</filter>\n") +
          "<tendon name=\"flexor\"><stiffness>2</stiffness><restLength>-1</restLength>"
          "<preTensionLength>70</preTensionLength>"
          "<insertionPoint><chain>-1</chain><link>-1</link><position>1 2 3</position>"
          "</insertionPoint><insertionPoint><chain>0</chain><link>0</link><position>4 5 "
          "6</position><friction>0.1</friction></insertionPoint></tendon>\n"
          "<tendonWrapper><chain>0</chain><link>0</link><position>0 0 1</position><orientation>0 3 "
          "0</orientation><radius>5</radius><exemption tendon=\"flexor\"/><wrapping_side "
          "tendon=\"flexor\"><orientation>2 0 0</orientation></wrapping_side></tendonWrapper>\n",
      warnings.options());
  REQUIRE(r.tendons.size() == 1);
  CHECK(r.tendons[0].name == "flexor");
  CHECK(r.tendons[0].stiffness == doctest::Approx(2000));
  CHECK_FALSE(r.tendons[0].rest_length);
  CHECK(*r.tendons[0].pre_tension_length == doctest::Approx(0.07));
  REQUIRE(r.tendons[0].points.size() == 2);
  CHECK(r.tendons[0].points[0].link == -1);
  CHECK(r.tendons[0].points[1].link == 0);
  CHECK(r.tendons[0].points[1].friction == 0.1);
  REQUIRE(r.wrappers.size() == 1);
  CHECK(r.wrappers[0].axis_L == Eigen::Vector3d(0, 1, 0));
  CHECK(r.wrappers[0].radius == doctest::Approx(0.005));
  CHECK(r.wrappers[0].length == doctest::Approx(0.01));
  CHECK(r.wrappers[0].exempt == std::vector<std::string>{"flexor"});
  CHECK(r.wrappers[0].sides.at(0).direction_L == Eigen::Vector3d(1, 0, 0));
  REQUIRE(r.tactile.size() == 1);
  CHECK(r.tactile[0].link == 0);
  CHECK((r.tactile[0].high_L - Eigen::Vector3d(0.003, 0.004, 0.005)).norm() < 1e-15);
  CHECK(warnings.list ==
        std::vector<std::string>{
            "hand.xml:9: tendons and their wrappers are kept, 1 and 1, but have no effect"});
}

TEST_CASE("a wrapper that names a tendon which does not exist is told") {
  Warnings warnings;
  const std::string point =
      "<insertionPoint><chain>-1</chain><link>-1</link><position>1 2 3</position></insertionPoint>";
  const RobotSpec r = read_xml_robot(
      dof() + chain(joint("d0") + link_of("Revolute")) + "<tendon name=\"flexor\">" + point +
          point +
          "</tendon>\n<tendonWrapper><chain>0</chain><link>0</link><position>0 0 1</position>"
          "<orientation>0 3 0</orientation><radius>5</radius>\n<exemption tendon=\"flexr\"/>"
          "\n<wrapping_side tendon=\"other\"><orientation>2 0 0</orientation></wrapping_side>"
          "</tendonWrapper>\n",
      warnings.options());
  CHECK(r.wrappers[0].exempt == std::vector<std::string>{"flexr"});
  REQUIRE(warnings.list.size() == 3);
  CHECK(warnings.list[0] ==
        "hand.xml:10: exemption: there is no tendon 'flexr'; did you mean 'flexor'?");
  CHECK(warnings.list[1] == "hand.xml:11: wrapping_side: there is no tendon 'other'");
}

TEST_CASE("types and elements that are unknown are warned of, a type that is missing is noted") {
  Warnings warnings;
  read_xml_robot(
      dof() + chain(joint("d0") + link_of("Revolute")) + "<eigengrasps>a.xml</eigengrasps>",
      warnings.options(), "type=\"Barret\"");
  REQUIRE(warnings.list.size() == 2);
  CHECK(warnings.list[0] ==
        "hand.xml:8: unknown element <eigengrasps> in <robot> is not used; did you mean "
        "'eigenGrasps'?");
  CHECK(warnings.list[1] ==
        "hand.xml:1: robot: unknown type 'Barret' has no meaning; did you mean 'Barrett'?");
  ReadOptions options;
  std::vector<std::string> notes;
  options.diagnostics = test::Listening{.note = [&](const std::string& s) { notes.push_back(s); }};
  CHECK(read_xml_robot(dof() + chain(joint("d0") + link_of("Revolute")), options, "").class_name ==
        "Hand");
  REQUIRE(notes.size() == 5);
  CHECK(notes[0] == "hand.xml:1: robot: no type; Hand is assumed");
  CHECK(notes[2] == "hand.xml: no material is given; wood is assumed: 'hand_base'");
  CHECK(
      notes[1] ==
      "hand.xml: no mass and no material is given; 0.3 kg of wood is assumed: 'hand_chain0_link0'");
}

TEST_CASE("a DOF that moves nothing is warned of") {
  Warnings warnings;
  read_xml_robot(dof() + dof() + chain(joint("d0") + link_of("Revolute")), warnings.options());
  CHECK(warnings.list == std::vector<std::string>{"hand.xml:4: DOF 1 moves no joint"});
}
