// Rules of MuJoCo 3 that are missing or different in MuJoCo 2.2.2. The values were computed by hand
// from the rule that each case names, and agree with MuJoCo 3.3.8.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "support/folder.h"
#include "support/listening.h"

using namespace clench;
using namespace clench::test;
using doctest::Approx;

namespace {

struct Scene {
  std::vector<std::string> warnings;
  WorldSpec world;
  std::string error;

  explicit Scene(const std::filesystem::path& path) {
    ReadOptions options;
    options.diagnostics =
        Listening{.warn = [this](const std::string& s) { warnings.push_back(s); }};
    try {
      world = read_world(path, options);
    } catch (const Error& e) {
      error = e.what();
    }
  }
  const PlacedBody& body(const std::string& name) const {
    for (const PlacedBody& placed : world.bodies)
      if (placed.body.name == name) return placed;
    FAIL("no body " << name);
    return world.bodies.at(0);
  }
  const LinkSpec& link(const std::string& name) const {
    for (const PlacedRobot& placed : world.robots)
      for (const LinkSpec& link : placed.robot.links)
        if (link.body.name == placed.robot.name + '_' + name) return link;
    FAIL("no link " << name);
    return world.robots.at(0).robot.links.at(0);
  }
  bool warned(const std::string& part) const {
    for (const auto& s : warnings)
      if (s.find(part) != std::string::npos) return true;
    return false;
  }
};

Scene scene(const std::string& in_world, const std::string& beside = "") {
  const TemporaryFolder folder;
  return Scene(folder.write("scene.xml", "<mujoco model='m'>" + beside + "<worldbody>" + in_world +
                                             "</worldbody></mujoco>"));
}

/// A free body with one geom, and its mass.
double mass_of(const std::string& geom, const std::string& beside = "") {
  return scene("<body name='b'><freejoint/>" + geom + "</body>", beside).body("b").body.mass;
}

const std::string box = "<geom type='box' size='0.1 0.2 0.3'/>";

}  // namespace

TEST_CASE("replicas stand in each other's frames, and their names end in padded numbers") {
  const Scene told = scene(
      "<replicate count='10' sep='_' offset='1 0 0' euler='0 0 90'><body name='b' pos='0 0 2'>"
      "<freejoint/>" +
      box + "</body></replicate>");
  CHECK(told.world.bodies.size() == 10);
  CHECK((told.body("b_00").X_WB.position - Eigen::Vector3d(0, 0, 2)).norm() < 1e-12);
  // (1 0 0), then a step along the turned axis
  CHECK((told.body("b_02").X_WB.position - Eigen::Vector3d(1, 1, 2)).norm() < 1e-12);
  CHECK(told.body("b_02").X_WB.angle() == Approx(std::numbers::pi));
  CHECK((told.body("b_04").X_WB.position - Eigen::Vector3d(0, 0, 2)).norm() < 1e-12);
}

TEST_CASE("in nested replicas the inner number comes first") {
  const Scene told = scene(
      "<replicate count='2' offset='0 1 0' euler='90 0 0'><replicate count='2' sep='-' offset='1 0 "
      "0' euler='0 90 0'><geom name='a' size='.1'/></replicate></replicate>");
  CHECK((told.body("a-10").X_WB.position - Eigen::Vector3d(1, 0, 0)).norm() < 1e-12);
  CHECK((told.body("a-01").X_WB.position - Eigen::Vector3d(0, 1, 0)).norm() < 1e-12);
  const Eigen::Quaterniond q = told.body("a-11").X_WB.rotation;
  CHECK(std::abs(q.dot(Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5))) == Approx(1));
}

TEST_CASE("elements that refer to replicas are replicated") {
  const Scene told = scene("<body name='base'>" + box +
                               "<replicate count='3' euler='0 0 120'><body name='f'>"
                               "<joint name='j' range='0 1'/>" +
                               box + "</body></replicate></body>",
                           "<actuator><position name='a' joint='j' kp='7'/></actuator>");
  REQUIRE(told.world.robots.size() == 1);
  const RobotSpec& robot = told.world.robots[0].robot;
  CHECK(robot.dofs.size() == 3);
  REQUIRE(robot.actuators.size() == 3);
  CHECK(robot.actuators[1].name == "a1");
  CHECK(robot.actuators[1].joint == "j1");
  for (const DofSpec& dof : robot.dofs) CHECK(dof.kp == 7);
  CHECK(scene("<replicate count='2'><joint/></replicate>").error ==
        "scene.xml:1: replicate: expected joints inside of a body only");
  CHECK(scene("<replicate count='0'/>").error ==
        "scene.xml:1: replicate: count: expected a count >= 1, got 0");
  CHECK(scene("<replicate count='1000'><replicate count='1000'>" + box + "</replicate></replicate>")
            .error == "scene.xml:1: expected at most 100000 elements made by replicate and attach");
  const Scene mixed = scene("<body name='one'><joint name='k'/>" + box +
                                "</body><replicate count='2'><body name='f'>"
                                "<joint name='j'/>" +
                                box + "</body></replicate>",
                            "<contact><exclude body1='one' body2='f'/></contact>");
  // references to other elements are unchanged
  REQUIRE(mixed.error == "");
  CHECK(mixed.world.never_meet.size() == 2);
}

TEST_CASE("an attached body keeps its own pose, units and classes, and gets a prefix") {
  const TemporaryFolder folder;
  folder.write("kid.xml", R"(<mujoco model="kid"><compiler angle="radian"/>
<default><geom density="500"/><joint damping="3"/><default class="c"><geom density="700"/></default></default>
<asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
<worldbody><frame name="fr" pos="0 0 5" childclass="c">
<body name="arm" pos="1 0 0" euler="0 0 0.5"><joint name="j" range="-1 1" axis="0 1 0"/><geom type="mesh" mesh="t"/></body>
</frame><body name="other"><joint name="o"/><geom size=".1"/></body></worldbody>
<actuator><position name="servo" joint="j" kp="3"/><motor joint="o"/></actuator></mujoco>)");
  const auto with = [&](const std::string& attach) {
    return Scene(folder.write(
        "scene.xml", R"(<mujoco><compiler angle="degree"/><default><joint damping="1"/></default>
<asset><model name="finger" file="kid.xml"/></asset><worldbody><frame pos="0 2 0">)" +
                         attach + "</frame></worldbody></mujoco>"));
  };
  const Scene body = with("<attach model='finger' body='arm' prefix='p_'/>");
  REQUIRE(body.error == "");
  const LinkSpec& arm = body.link("p_arm");
  CHECK(arm.joints.at(0).name == "p_j");
  CHECK(arm.joints[0].max == 1);
  CHECK(arm.joints[0].viscous == 3);
  CHECK(arm.body.mass == Approx(700.0 / 6));
  // frames around the body are omitted
  CHECK((link_in_parent(arm, {0}).position - Eigen::Vector3d(1, 2, 0)).norm() < 1e-12);
  CHECK(link_in_parent(arm, {0}).angle() == Approx(0.5));
  REQUIRE(body.world.robots[0].robot.actuators.size() == 1);
  CHECK(body.world.robots[0].robot.actuators[0].joint == "p_j");
  const Scene frame = with("<attach model='finger' frame='fr' prefix='p_'/>");
  CHECK((link_in_parent(frame.link("p_arm"), {0}).position - Eigen::Vector3d(1, 2, 5)).norm() <
        1e-12);
  const Scene all = with("<attach model='finger' prefix='p_'/>");
  CHECK(all.world.robots.size() == 2);
  CHECK(with("<attach model='fingr' body='arm' prefix='p_'/>").error ==
        "scene.xml:2: attach: model: no model 'fingr'; did you mean 'finger'?");
  CHECK(with("<attach model='finger' body='arn' prefix='p_'/>").error ==
        "scene.xml:2: attach: body: no body 'arn'; did you mean 'arm'?");
}

TEST_CASE("a body attached from the same model is a renamed copy") {
  const Scene told = scene("<body name='b' pos='1 0 0'><freejoint/>" + box +
                           "</body><frame pos='0 3 0'><attach body='b' prefix='q'/></frame>");
  CHECK((told.body("qb").X_WB.position - Eigen::Vector3d(1, 3, 0)).norm() < 1e-12);
}

TEST_CASE("the nearest alternative to a quaternion counts, wherever the quaternion is") {
  const std::string classes =
      "<default><default class='e'><geom euler='90 0 0'/></default><default class='z'><geom "
      "zaxis='1 0 0'/></default></default>";
  const auto rotation = [&](const std::string& geom) {
    return scene("<geom name='g' type='box' size='.1 .1 .1' " + geom + "/>", classes)
        .body("g")
        .X_WB.rotation;
  };
  const Eigen::Quaterniond about_x(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond about_z(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  CHECK(rotation("class='e' quat='0 1 0 0'").angularDistance(about_x) < 1e-9);
  CHECK(rotation("class='e' axisangle='0 0 1 90'").angularDistance(about_z) < 1e-9);
  CHECK(rotation("class='z' xyaxes='0 1 0 -1 0 0'").angularDistance(about_z) < 1e-9);
  CHECK(scene("<geom size='1' euler='0 0 0' zaxis='0 0 1'/>").error ==
        "scene.xml:1: geom: expected one of axisangle, euler, xyaxes and zaxis, got 2");
}

TEST_CASE("an element that gives fewer numbers leaves the others to its class") {
  const std::string classes = "<default><geom type='capsule' size='0.01 0.03'/></default>";
  CHECK(mass_of("<geom size='0.02'/>", classes) ==
        Approx(1000 * std::numbers::pi * (4e-4 * 0.06 + 4.0 / 3 * 8e-6)));
}

TEST_CASE("a mesh's mass follows its rule") {
  // a U of five unit cubes: 5 m^3, its hull 6 m^3
  const std::string corners =
      "vertex='0 0 0 3 0 0 3 2 0 2 2 0 2 1 0 1 1 0 1 2 0 0 2 0 0 0 1 3 0 1 3 2 1 2 2 1 "
      "2 1 1 1 1 1 1 2 1 0 2 1' face='0 4 1 1 3 2 1 4 3 0 5 4 0 7 5 5 7 6 8 9 12 9 10 "
      "11 9 11 12 8 12 13 8 13 15 13 14 15 0 1 9 0 9 8 1 2 10 1 10 9 2 3 11 2 11 10 3 4 "
      "12 3 12 11 4 5 13 4 13 12 5 6 14 5 14 13 6 7 15 6 15 14 7 0 8 7 8 15'";
  const auto mass = [&](const std::string& more) {
    return mass_of("<geom type='mesh' mesh='u' density='1'/>",
                   "<asset><mesh name='u' " + corners + more + "/></asset>");
  };
  CHECK(mass(" inertia='exact'") == Approx(5));
  CHECK(mass(" inertia='convex'") == Approx(6));
  CHECK(mass(" inertia='shell'") == Approx(22));
  CHECK(mass("") == mass(" inertia='legacy'"));
  // some of the pyramids from the centroid to the faces are outside, and count nevertheless
  CHECK(mass("") == Approx(17.0 / 3));
}

TEST_CASE("surfaces have mass where a geom says so") {
  CHECK(mass_of("<geom type='box' size='.1 .2 .3' shellinertia='true'/>") == Approx(880));
  CHECK(mass_of("<geom type='capsule' size='.1 .2' shellinertia='true'/>") == Approx(376.9911184));
  CHECK(mass_of("<geom type='cylinder' size='.1 .2' shellinertia='true'/>") == Approx(314.1592654));
  CHECK(mass_of("<geom type='ellipsoid' size='.1 .2 .3' shellinertia='true'/>") ==
        Approx(489.7193333));
  const auto moments = [](const std::string& geom) {
    const BodySpec body = scene("<body name='b'><freejoint/>" + geom + "</body>").body("b").body;
    return Eigen::Vector3d(body.mass * body.inertia_per_mass->diagonal());
  };
  using Eigen::Vector3d;
  CHECK((moments("<geom type='box' size='.1 .2 .3' shellinertia='true'/>") -
         Vector3d(54.13333333, 42.13333333, 24.26666667))
            .norm() < 1e-6);
  CHECK((moments("<geom type='capsule' size='.1 .2' shellinertia='true'/>") -
         Vector3d(12.98524963, 12.98524963, 3.351032164))
            .norm() < 1e-6);
  CHECK((moments("<geom type='cylinder' size='.1 .2' shellinertia='true'/>") -
         Vector3d(7.278022981, 7.278022981, 2.827433388))
            .norm() < 1e-6);
  // MuJoCo's value is that of a shell of finite thickness
  CHECK((moments("<geom type='ellipsoid' size='.1 .2 .3' shellinertia='true'/>") -
         Vector3d(18.07517488, 14.06836658, 8.102680937))
            .norm() < 1e-3);
}

TEST_CASE("built-in meshes have the volumes of MuJoCo's") {
  const auto mass = [](const std::string& kind, const std::string& params) {
    return mass_of("<geom type='mesh' mesh='m'/>", "<asset><mesh name='m' builtin='" + kind +
                                                       "' params='" + params + "'/></asset>");
  };
  CHECK(mass("sphere", "0") == Approx(2536.1504727));
  CHECK(mass("sphere", "1") == Approx(3658.7123).epsilon(1e-6));
  CHECK(mass("hemisphere", "0") == Approx(666.6666667));
  CHECK(mass("hemisphere", "1") == Approx(1471.4044624));
  CHECK(mass("cone", "3 0") == Approx(866.0254));
  CHECK(mass("cone", "3 0.5") == Approx(1515.5444568));
  CHECK(mass("supersphere", "3 1 1") == Approx(1299.0381057));
  CHECK(mass("supertorus", "3 0.5 1 1") == Approx(1687.5));
  const auto error = [](const std::string& attributes) {
    return scene("<geom type='mesh' mesh='m'/>",
                 "<asset><mesh name='m' " + attributes + "/></asset>")
        .error;
  };
  CHECK(error("builtin='cone' params='3'") ==
        "scene.xml:1: mesh: builtin: cone: expected 2 parameters, got 1");
  CHECK(error("builtin='cone' params='2 0'") ==
        "scene.xml:1: mesh: builtin: cone: nvert: expected a whole number from 3 to 300, got 2");
  CHECK(error("builtin='spere' params='2'").find("did you mean 'sphere'?") != std::string::npos);
}

TEST_CASE("primitives are fitted to the inertia or the bounds of a mesh") {
  const std::string mesh =
      "<asset><mesh name='w' vertex='0 0 0  .3 0 0  .05 .1 0  .02 .03 .06 .1 .11 .07'/></asset>";
  const auto mass = [&](const std::string& type, const std::string& compiler) {
    return mass_of("<geom type='" + type + "' mesh='w' size='1 1 1'/>", compiler + mesh);
  };
  const std::string bounds = "<compiler fitaabb='true'/>";
  // half edges, radii and half lengths of MuJoCo 3.3.8
  CHECK(mass("box", "") == Approx(5859.760763807377 / 8 / 1000).epsilon(1e-5));
  CHECK(mass("capsule", "") == Approx(0.6622824843).epsilon(1e-5));
  CHECK(mass("sphere", "") == Approx(0.6139149792).epsilon(1e-5));
  CHECK(mass("cylinder", "") == Approx(0.6253807188).epsilon(1e-5));
  CHECK(mass("sphere", bounds) ==
        Approx(4000 * std::numbers::pi / 3 * std::pow(0.1483525696, 3)).epsilon(1e-5));
  CHECK(mass("box", bounds) ==
        Approx(1000 * 0.08076165929 * 0.1411426598 * 0.2967051391).epsilon(1e-5));
}

TEST_CASE("bodies have the mass of their geoms") {
  const Scene told = scene(
      "<body name='arm'><joint name='j' axis='0 1 0'/><geom size='.05' pos='0 0 .5' mass='1'/>"
      "<body name='flag'><geom size='.1' mass='0'/></body>"
      "<body name='plate'><geom size='.1' density='0'/></body>"
      "<body name='far'><geom size='.1' group='4'/></body>"
      "<body name='tip'><inertial pos='0 0 0' mass='0'/></body></body>"
      "<body name='ghost'><freejoint/><geom size='.1' mass='0'/></body>",
      "<compiler inertiagrouprange='0 3'/>");
  for (const char* name : {"flag", "plate", "far", "tip"}) CHECK(told.link(name).body.mass < 1e-11);
  CHECK(told.link("arm").body.mass == 1);
  CHECK(told.body("ghost").body.mass == 1e-3);
  CHECK(told.warned("scene.xml:1: body 'ghost' moves and has no mass; 0.001 kg is used"));
}

TEST_CASE("a start outside of a joint's limits is reported with both values") {
  const Scene told = scene(
      "<body name='b'><geom size='.05'/><body name='leg'><joint name='knee' axis='0 1 0' "
      "range='30 70'/><geom size='.02'/></body></body>");
  CHECK(
      told.warned("scene.xml:1: joint 'knee': expected a start within its limits [0.523599, "
                  "1.22173] rad, got 0; it starts at 0.523599"));
}

TEST_CASE("bodies without names are called by numbers that no other one has") {
  const Scene told = scene(
      "<body><geom size='.1'/></body><body name='body1'><geom size='.1'/>"
      "</body><body><freejoint/><geom size='.1'/><body><geom size='.1'/></body>"
      "<body><geom size='.1'/></body></body>");
  CHECK(told.error == "");
  CHECK(told.warnings.empty());
}

TEST_CASE("free joints are found in frames and by their classes") {
  const Scene told = scene("<body name='a'><frame pos='0 0 .1'><freejoint/>" + box +
                               "</frame></body>"
                               "<body name='b'><joint class='f'/>" +
                               box +
                               "</body>"
                               "<body name='c' childclass='f'><joint/>" +
                               box + "</body>",
                           "<default><default class='f'><joint type='free'/></default></default>");
  for (const char* name : {"a", "b", "c"}) CHECK(told.body(name).role == Role::object);
}
