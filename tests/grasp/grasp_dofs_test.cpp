// DOFs of grasps from other programs: their names, orders, followers and limits.
#include "clench/grasp/wrench/grasp_dofs.h"

#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "clench/model/dof.h"
#include "support/folder.h"
#include "support/listening.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

constexpr const char* shape =
    "<collision><geometry><box size='0.01 0.01 0.01'/></geometry></collision>";

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const char* more = "", const char* kind = "revolute") {
  return "<link name='" + child + "'>" + shape + "</link><joint name='" + name + "' type='" + kind +
         "'><parent link='" + parent + "'/><child link='" + child +
         "'/><origin xyz='0 0 0.05'/><axis xyz='0 1 0'/><limit lower='-0.5' upper='1.57' "
         "effort='1' velocity='1'/>" +
         more + "</joint>";
}

/// Two fingers of two joints each; the last joint of the second finger follows that of the first.
struct Hand {
  World world;
  Id<Robot> hand;
  Id<Body> object;
  std::vector<std::string> said;

  explicit Hand(bool follows = true, const char* kind = "revolute", const char* offset = "") {
    const TemporaryFolder folder;
    const std::string mimic = "<mimic joint='a2' multiplier='0.5'" + std::string(offset) + "/>";
    const std::string urdf = "<robot name='twin'><link name='palm'>" + std::string(shape) +
                             "</link>" + joint("a1", "palm", "la1", "", kind) +
                             joint("a2", "la1", "la2") + joint("b1", "palm", "lb1") +
                             joint("b2", "lb1", "lb2", follows ? mimic.c_str() : "") + "</robot>";
    hand = world.add_robot(read_robot(folder.write("twin.urdf", urdf), {}), {});
    object = world.add_body(body_spec("cube", box(0.05, 0.05, 0.05)), BodyKind::object, {});
  }

  GraspSpec grasp(std::vector<std::string> names, std::vector<double> values) const {
    GraspSpec g;
    g.hand_name = "twin";
    g.object_name = "cube";
    g.X_OH = Pose{};
    g.dof_names = std::move(names);
    g.dofs = std::move(values);
    return g;
  }
  std::vector<double> apply(const GraspSpec& g, DofOrder order = DofOrder::unknown) {
    said.clear();
    apply_grasp(world, g, hand, object,
                {.order = order, .diagnostics = Listening{.warn = [&](const std::string& text) {
                                   said.push_back(text);
                                 }}});
    const auto q = world.dofs(hand);
    return {q.begin(), q.end()};
  }
};

using Numbers = std::vector<double>;

}  // namespace

TEST_CASE(
    "a value within 32-bit rounding of a limit becomes the limit, one slightly beyond is clamped "
    "with a warning, one far beyond is rejected") {
  Hand h;
  const auto set = [&](double a1) { return h.apply(h.grasp({"a1"}, {a1}))[0]; };
  CHECK(set(1.5700000524520874) == 1.57);
  CHECK(set(-0.5000000298023224) == -0.5);
  CHECK(h.said.empty());
  CHECK(set(1.5702) == 1.57);
  REQUIRE(h.said.size() == 1);
  CHECK(h.said[0] ==
        "grasp of cube by twin: robot 'twin': DOF 1 'a1': 1.5702 exceeds the limit 1.57 rad; "
        "the limit is used");
  CHECK(set(-0.519) == -0.5);
  CHECK_THROWS_WITH_AS(
      set(1.6),
      "grasp of cube by twin: robot 'twin': DOF 1 'a1' must lie in [-0.5, 1.57] rad, "
      "got 1.6",
      Error);
  CHECK_THROWS_WITH_AS(set(45), doctest::Contains("degrees? clench.rad(45) is 0.7854"), Error);
  CHECK_THROWS_WITH_AS(set(NAN), doctest::Contains("must be finite"), Error);
  // tolerances of prismatic joints are millimeters
  Hand sliding(true, "prismatic");
  const auto slide = [&](double a1) { return sliding.apply(sliding.grasp({"a1"}, {a1}))[0]; };
  CHECK(slide(1.5705) == 1.57);
  CHECK(sliding.said.size() == 1);
  CHECK_THROWS_WITH_AS(slide(1.58), doctest::Contains("must lie in [-0.5, 1.57] m"), Error);
}

TEST_CASE("a hand keeps its state if a grasp does not fit it") {
  Hand h;
  const auto before = h.apply(h.grasp({"a1", "a2", "b1"}, {0.1, 0.2, 0.3}));
  GraspSpec g = h.grasp({"a1", "b1"}, {0.4, 3});
  g.X_OH = Pose::translation({1, 0, 0});
  CHECK_THROWS_AS(h.apply(g), Error);
  const auto after = h.world.dofs(h.hand);
  CHECK(std::ranges::equal(before, after));
  CHECK(h.world.pose(h.world.robot(h.hand).base) == Pose{});
}

TEST_CASE("values of following joints may be listed in addition to their leaders, and alone") {
  Hand h;
  CHECK(h.apply(h.grasp({"b2", "a1", "a2", "b1"}, {0.1, 0.3, 0.2, 0.4})) == Numbers{0.3, 0.2, 0.4});
  CHECK(h.said.empty());
  // to 32-bit rounding
  h.apply(h.grasp({"a2", "b2"}, {0.2, 0.10000000149}));
  CHECK(h.said.empty());
  CHECK(h.apply(h.grasp({"b2"}, {0.25}))[1] == 0.5);
  CHECK(h.said.empty());
  CHECK(h.apply(h.grasp({"a2", "b2"}, {0.2, 0.15}))[1] == 0.2);
  REQUIRE(h.said.size() == 1);
  CHECK(h.said[0] ==
        "grasp of cube by twin: joint 'b2' moves with DOF 'a2', which puts it at 0.1, not at 0.15; "
        "the DOF is used");
  CHECK_THROWS_WITH_AS(h.apply(h.grasp({"c"}, {0})), doctest::Contains("the hand has no DOF 'c'"),
                       Error);
}

TEST_CASE("the value of a following joint includes the offset of its mimic") {
  Hand h(true, "revolute", " offset='0.1'");
  CHECK(h.apply(h.grasp({"a1", "a2", "b1", "b2"}, {0.3, 0.2, 0.4, 0.2})) == Numbers{0.3, 0.2, 0.4});
  CHECK(h.said.empty());
  CHECK(h.apply(h.grasp({"b2"}, {0.25}))[1] == doctest::Approx(0.3));
  CHECK(h.said.empty());
  h.apply(h.grasp({"a2", "b2"}, {0.2, 0.1}));
  REQUIRE(h.said.size() == 1);
  CHECK(h.said[0] ==
        "grasp of cube by twin: joint 'b2' moves with DOF 'a2', which puts it at 0.2, not at 0.1; "
        "the DOF is used");
  // of a1, b1, a2, b2
  CHECK(h.apply(h.grasp({}, {0.1, 0.3, 0.2, 0.2}), DofOrder::isaac) == Numbers{0.1, 0.2, 0.3});
  CHECK(h.said.empty());
}

TEST_CASE(
    "DOFs without names are taken in the hand's order, with a warning if Isaac Sim has another "
    "order") {
  Hand h(false);
  const GraspSpec g = h.grasp({}, {0.11, 0.21, 0.12, 0.22});
  CHECK(h.apply(g) == Numbers{0.11, 0.21, 0.12, 0.22});
  REQUIRE(h.said.size() == 1);
  CHECK(h.said[0] ==
        "grasp of cube by twin: it does not name its DOFs, which are taken in the hand's "
        "order: a1, a2, b1, b2; Isaac Sim's order is a1, b1, a2, b2, for dof_order = \"isaac\"");
  CHECK(h.apply(g, DofOrder::hand) == Numbers{0.11, 0.21, 0.12, 0.22});
  CHECK(h.said.empty());
  CHECK(h.apply(g, DofOrder::isaac) == Numbers{0.11, 0.12, 0.21, 0.22});
  CHECK(h.said.empty());
  const Robot& robot = h.world.robot(h.hand);
  CHECK(listed_dof_names(robot, 4, DofOrder::isaac) ==
        std::vector<std::string>{"a1", "b1", "a2", "b2"});
  CHECK_THROWS_WITH_AS(h.apply(h.grasp({}, {1, 2})),
                       "grasp of cube by twin: it has 2 DOFs and 0 joints, the hand 4 and 4",
                       Error);
}

TEST_CASE("without names there may be a value for every joint, including followers") {
  Hand h;
  // of a1, b1, a2, b2
  CHECK(h.apply(h.grasp({}, {0.1, 0.3, 0.2, 0.1}), DofOrder::isaac) == Numbers{0.1, 0.2, 0.3});
  CHECK(h.said.empty());
  CHECK(h.apply(h.grasp({}, {0.1, 0.3, 0.2}), DofOrder::isaac) == Numbers{0.1, 0.2, 0.3});
  const Robot& robot = h.world.robot(h.hand);
  CHECK(listed_dof_names(robot, 4, DofOrder::isaac) ==
        std::vector<std::string>{"a1", "b1", "a2", "b2"});
  CHECK(listed_dof_names(robot, 3, DofOrder::hand) == std::vector<std::string>{"a1", "a2", "b1"});
  CHECK_THROWS_WITH_AS(
      listed_dof_names(robot, 5, DofOrder::isaac),
      "dof_order: expected as many values as 'twin' has DOFs, 3, or joints, 4, got 5", Error);
}

TEST_CASE("the DOFs of a pregrasp are matched by the names of the grasp") {
  Hand h;
  GraspSpec g = h.grasp({"b1", "a1"}, {0.3, 0.1});
  g.pregrasp = PregraspState{Pose{}, {1.5702, 0.2}};
  std::vector<std::string> said;
  const GraspDofOptions options{
      .diagnostics = Listening{.warn = [&](const std::string& text) { said.push_back(text); }}};
  const GraspPosture posture = grasp_posture(h.world, h.hand, g, Place("g"), options);
  CHECK(posture.dofs == Eigen::Vector3d(0.1, 0, 0.3));
  CHECK(pregrasp_dofs(h.world, h.hand, g, posture, Place("g"), options) ==
        Eigen::Vector3d(0.2, 0, 1.57));
  CHECK(said.size() == 1);
  g.pregrasp->dofs = {1};
  CHECK_THROWS_WITH_AS(pregrasp_dofs(h.world, h.hand, g, posture, Place("g"), options),
                       "g: pregrasp: expected 2 values, one per name of a DOF, got 1", Error);
}

TEST_CASE("a breadth-first order treats links without joints as parts of their parents") {
  Robot robot;
  // palm: a fixed spacer with a finger of two joints, and a finger of one link with two joints
  robot.links.resize(4);
  robot.joints.resize(5);
  const auto set = [&](size_t link, int parent, int first, int end) {
    robot.links[link].parent = parent;
    robot.links[link].first_joint = first;
    robot.links[link].end_joint = end;
  };
  set(0, -1, 0, 0);
  set(1, 0, 0, 1);
  set(2, 1, 1, 2);
  set(3, -1, 2, 5);
  CHECK(breadth_first_joints(robot) == std::vector<int>{0, 2, 1, 3, 4});
}
