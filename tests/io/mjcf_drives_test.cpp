// Efforts of the drives of MJCF robots: signs, one-sided ranges, kinds of actuators, switches.
#include <cmath>

#include "clench/io/mjcf/mjcf.h"
#include "clench/spec/dof_drive.h"
#include "temporary.h"
#include "told_robot.h"
#include "written_robot.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;
using clench::test::written;

namespace {

constexpr double none = DriveTerm::none;

/// Sliding joints a and b of a base; `joint` are their attributes, `option` those of the file.
ToldRobot two(const std::string& rest, const std::string& joint = "",
              const std::string& option = "") {
  TemporaryFolder folder;
  std::string bodies;
  for (const char* name : {"a", "b"})
    bodies += fmt::format(
        "<body name='{0}' pos='0 0 1'><joint name='{0}' type='slide' axis='0 1 0' range='0 0.1' "
        "{1}/>"
        "<geom size='0.1'/></body>",
        name, joint);
  return ToldRobot(folder.write("m.xml", "<mujoco model='m'>" + option +
                                             "<worldbody><body name='base'><geom size='0.1'/>" +
                                             bodies + "</body></worldbody>" + rest + "</mujoco>"));
}

ToldRobot actuated(const std::string& actuator, const std::string& joint = "") {
  return two("<actuator>" + actuator + "</actuator>", joint);
}

EffortRange at_rest(const RobotSpec& robot, double q = 0) {
  return drive_of(robot, 0).at_rest(
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(robot.dofs.size()), q));
}

std::string tendon(double a, double b, const std::string& actuator, const std::string& more = "") {
  return fmt::format(
      "<tendon><fixed name='t' {}><joint joint='a' coef='{}'/><joint joint='b' coef='{}'/></fixed>"
      "</tendon><actuator>{}</actuator>",
      more, a, b, actuator);
}

}  // namespace

TEST_CASE("a motor on a tendon pulls with the sign of its coefficients") {
  const std::string motor = "<motor tendon='t' ctrllimited='true' ctrlrange='0 50'/>";
  const RobotSpec opens = two(tendon(-1, -1, motor)).robot;
  CHECK(opens.dofs.size() == 1);
  CHECK(at_rest(opens) == EffortRange{-100, 0});
  CHECK(at_rest(two(tendon(0.5, 1, motor)).robot) == EffortRange{0, 50 * (0.5 + 1 * 2)});
  // b moves twice as far in the opposite direction
  const RobotSpec against = two(tendon(1, -2, motor)).robot;
  CHECK(at_rest(against) == EffortRange{0, 50 + 4 * 50});
  // a second motor on a joint leaves both independent
  const RobotSpec apart = two(tendon(-1, 2, motor + "<motor joint='a' ctrlrange='0 3'/>")).robot;
  REQUIRE(apart.dofs.size() == 2);
  CHECK(at_rest(apart) == EffortRange{-50, 3});
  CHECK(drive_of(apart, 1).at_rest(Eigen::Vector2d(0, 0)) == EffortRange{0, 100});
}

TEST_CASE("an actuatorfrcrange bounds each direction separately") {
  const std::string motor = "<motor joint='a' ctrlrange='-50 50'/>";
  CHECK(at_rest(actuated(motor, "actuatorfrcrange='-20 0.001'").robot) == EffortRange{-20, 0.001});
  const ToldRobot one_sided = actuated(motor, "actuatorfrclimited='true' actuatorfrcrange='-20 0'");
  CHECK(at_rest(one_sided.robot) == EffortRange{-20, 0});
  CHECK(one_sided.dof("a").max_effort == 20);
  CHECK(one_sided.warnings.empty());
  CHECK(at_rest(two(tendon(1, 1, "<motor tendon='t' ctrlrange='-50 50'/>",
                           "actuatorfrclimited='true' actuatorfrcrange='-20 0'"))
                    .robot) == EffortRange{-40, 0});
}

TEST_CASE("muscles only pull, with a peak force where one is given") {
  const std::string muscle = "<muscle joint='a' ctrllimited='true' ctrlrange='0 1' ";
  CHECK(at_rest(actuated(muscle + "/>").robot) == EffortRange{-none, 0});
  const EffortRange pulls = at_rest(actuated(muscle + "gear='-1' force='10'/>").robot);
  CHECK(pulls.low == 0);
  CHECK(pulls.high > 10);
  CHECK(pulls.high < 10.5);  // passive, at its largest length
  CHECK(at_rest(actuated("<general joint='a' gaintype='muscle' biastype='muscle' dyntype='muscle' "
                         "gainprm='0.75 1.05 8 200 0.5 1.6 1.5 0 1.2' ctrlrange='0 0.5'/>")
                    .robot) == EffortRange{-4, 0});
  CHECK(at_rest(actuated("<muscle joint='a' force='0'/>").robot).is_zero());
}

TEST_CASE("a cylinder exerts its area times its control") {
  const std::string cylinder = "<cylinder joint='a' ctrllimited='true' ctrlrange='0 2' ";
  CHECK(at_rest(actuated(cylinder + "area='3'/>").robot) == EffortRange{0, 6});
  CHECK(at_rest(actuated(cylinder + "diameter='2' bias='-1'/>").robot).high ==
        doctest::Approx(2 * 3.14159265358979 - 1));
  const ToldRobot none_at_all = actuated(cylinder + "name='c' area='0'/>");
  CHECK_FALSE(none_at_all.dof("a").driven);
  CHECK(none_at_all.warned("drive nothing: 'c'"));
  CHECK(none_at_all.warned("<cylinder>: its control acts at once"));
}

TEST_CASE("dampers hold nothing, and an integrator reaches what its control and its range allow") {
  CHECK_FALSE(actuated("<damper joint='a' kv='100' ctrlrange='0 1'/>").dof("a").driven);
  CHECK_FALSE(actuated("<position joint='a' kp='0' kv='9'/>").dof("a").driven);
  const std::string servo = "<intvelocity joint='a' kp='100' ";
  const ToldRobot opens = actuated(servo + "actrange='-0.1 0'/>");
  CHECK(at_rest(opens.robot) == EffortRange{-10, 0});
  CHECK(opens.dof("a").kp == 100);
  CHECK(opens.warned("<intvelocity>: targets of its motor represent its activation"));
  CHECK(at_rest(actuated(servo + "actrange='-1 1' ctrlrange='-1 0'/>").robot) ==
        EffortRange{-100, 0});
  CHECK(at_rest(actuated(servo + "ctrlrange='-1 1'/>").robot) == EffortRange{-none, none});
  const RobotSpec inherits = actuated(servo + "inheritrange='1' ctrlrange='-5 5'/>").robot;
  CHECK(*inherits.actuators[0].control_range == std::array{-5.0, 5.0});
  CHECK(*inherits.actuators[0].activation_range == std::array{0.0, 0.1});
}

TEST_CASE("a servo on a follower feels the offset of its joint") {
  const RobotSpec robot =
      two("<equality><joint joint1='b' joint2='a' polycoef='0.05 1'/></equality><actuator>"
          "<general joint='b' gainprm='100' biastype='affine' biasprm='0 -100 0' ctrlrange='0 "
          "0.06'/>"
          "</actuator>")
          .robot;
  CHECK(at_rest(robot, 0).high == doctest::Approx(1));
  CHECK(at_rest(robot, 0.02).high == doctest::Approx(-1));
}

TEST_CASE("actuators that an option switches off drive nothing, which is reported") {
  const std::string motors =
      "<actuator><motor name='x' joint='a' group='2'/><motor name='y' joint='b'/></actuator>";
  const ToldRobot all = two(motors, "", "<option><flag actuation='disable'/></option>");
  CHECK_FALSE(all.dof("a").driven);
  CHECK_FALSE(all.dof("b").driven);
  CHECK(all.warned(
      "flag: actuation=\"disable\" switches actuators off; they drive nothing: 'x', 'y'"));
  const ToldRobot one = two(motors, "", "<option actuatorgroupdisable='1 2'/>");
  CHECK_FALSE(one.dof("a").driven);
  CHECK(one.dof("b").driven);
  CHECK(one.warned("actuatorgroupdisable switches actuators off; they drive nothing: 'x'"));
  CHECK(one.warnings.size() == 1);
  // other settings of an option are not used for a robot alone
  const ToldRobot more = two(
      motors, "", "<option timestep='0.01'><flag actuation='disable' gravity='disable'/></option>");
  CHECK(more.warned("attributes of <option> that are not used, here and further on: timestep"));
  CHECK(more.warned("attributes of <flag> that are not used, here and further on: gravity"));
  CHECK(two(motors, "", "<option timestep='0.01'/>").warned("<option> is not used"));
  CHECK(two(motors, "", "<option><flag actuation='enable'/></option>").warnings.empty());
  CHECK_THROWS_WITH(two(motors, "", "<option actuatorgroupdisable='1 x'/>"),
                    doctest::Contains("actuatorgroupdisable: expected a number, got 'x'"));
  CHECK_THROWS_WITH(two(motors, "", "<option actuatorgroupdisable='31'/>"),
                    doctest::Contains("expected integers from 0 to 30, got 31"));
}

TEST_CASE("masses that the compiler's bounds and total change are reported") {
  const auto weighed = [](const std::string& compiler) {
    TemporaryFolder folder;
    return ToldRobot(folder.write(
        "m.xml", "<mujoco><compiler " + compiler +
                     "/><worldbody><body name='base'><geom size='0.1' mass='1'/><body name='tip'>"
                     "<joint name='j' range='0 1'/><geom size='0.1' mass='3'/></body></body>"
                     "</worldbody></mujoco>"));
  };
  const ToldRobot raised = weighed("boundmass='2'");
  CHECK(raised.body("base").mass == 2);
  CHECK(raised.noted("m.xml: boundmass and boundinertia raise the mass or inertia of: 'base'"));
  CHECK_FALSE(weighed("boundmass='1' boundinertia='1e-9'").noted("raise"));
  const ToldRobot scaled = weighed("settotalmass='6'");
  CHECK(scaled.body("tip").mass == doctest::Approx(4.5));
  CHECK(scaled.noted("settotalmass scales the masses of all bodies by 1.5, from 4 to 6 kg"));
  CHECK_FALSE(weighed("settotalmass='4'").noted("settotalmass"));
}

TEST_CASE("a URDF keeps what its actuators exert") {
  const std::vector<ToldRobot> robots = {
      two(tendon(-1, 2, "<motor tendon='t' ctrlrange='0 5'/><motor joint='a' ctrlrange='-1 2'/>",
                 "actuatorfrcrange='-3 4'")),
      actuated("<intvelocity joint='a' kp='100' actrange='-0.1 0'/>", "actuatorfrcrange='-2 1'"),
      actuated("<muscle joint='a'/><general joint='b' gaintype='affine' gainprm='1 2 3'/>"),
      two("<actuator><motor joint='a'/></actuator>", "",
          "<option><flag actuation='disable'/></option>"),
      two("<equality><joint joint1='b' joint2='a' polycoef='0.05 -1'/></equality><actuator>"
          "<general joint='b' gainprm='9' biastype='affine' biasprm='0 -9 0' ctrlrange='0 "
          "1'/></actuator>")};
  TemporaryFolder folder;
  for (const ToldRobot& told : robots) {
    const RobotSpec back = written(told.robot, folder.path() / "back.urdf").robot;
    REQUIRE(back.dofs.size() == told.robot.dofs.size());
    for (int d = 0; d < static_cast<int>(back.dofs.size()); ++d) {
      const Eigen::VectorXd q =
          Eigen::VectorXd::Constant(static_cast<Eigen::Index>(back.dofs.size()), 0.03);
      CHECK(back.dofs[d].driven == told.robot.dofs[d].driven);
      const EffortRange ours = drive_of(told.robot, d).at_rest(q),
                        theirs = drive_of(back, d).at_rest(q);
      CHECK((theirs.low == ours.low || std::abs(theirs.low - ours.low) < 1e-12));
      CHECK((theirs.high == ours.high || std::abs(theirs.high - ours.high) < 1e-12));
    }
  }
}
