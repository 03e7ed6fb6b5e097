// Limits on the work that small MJCF files may request.
#include "clench/base/error.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using namespace clench::test;

namespace {

WorldSpec limited_scene(const std::string& text) {
  const TemporaryFolder folder;
  return read_world(folder.write("m.xml", "<mujoco>" + text + "</mujoco>"), {});
}

std::string repeated_text(size_t count, const std::string& text) {
  std::string out;
  for (size_t i = 0; i < count; ++i) {
    std::string one = text;
    for (size_t at; (at = one.find('%')) != std::string::npos;)
      one.replace(at, 1, std::to_string(i));
    out += one;
  }
  return out;
}

std::string many_bodies(size_t count, const std::string& inside) {
  return "<worldbody>" + repeated_text(count, "<body name='b%'>" + inside + "</body>") +
         "</worldbody>";
}

}  // namespace

TEST_CASE("thousands of free bodies are read, with bits where those keep some apart") {
  const WorldSpec free = limited_scene(
      "<worldbody><replicate count='3000' offset='1 0 0'><body name='b'><freejoint/>"
      "<geom size='.1'/></body></replicate></worldbody>");
  CHECK(free.bodies.size() == 3000);
  CHECK(free.collision_bits.empty());
  const WorldSpec apart =
      limited_scene(many_bodies(30, "<freejoint/><geom size='.1' contype='2' conaffinity='4'/>"));
  CHECK(apart.collision_bits.size() == 30);
  CHECK(apart.collision_bits.front().second == CollisionBits{.type = 2, .affinity = 4});
  CHECK(apart.never_meet.empty());
}

TEST_CASE("thousands of fixed bodies never collide, but for the pairs that a file lists") {
  const std::string box = "type='box' size='.1 .1 .1'/>";
  const WorldSpec fixed = limited_scene(
      "<worldbody><replicate count='1100' offset='1 0 0'><body>"
      "<geom " +
      box + "</body></replicate></worldbody>");
  CHECK(fixed.never_meet.empty());
  CHECK(fixed.collision_bits.size() == 1100);
  const WorldSpec pair = limited_scene(
      many_bodies(1100, "<freejoint/><geom name='g%' contype='2' conaffinity='4' " + box) +
      "<contact><pair geom1='g0' geom2='g7'/></contact>");
  CHECK(pair.never_meet.empty());
  REQUIRE(pair.always_meet.size() == 1);
  CHECK(pair.always_meet[0][1].index == 7);
}

TEST_CASE("frictions, robots and keyframes of a scene are limited") {
  CHECK_THROWS_WITH_AS(
      limited_scene(many_bodies(501, "<freejoint/><geom size='.1' friction='.%1'/>")),
      "m.xml: geom: expected at most 500 different frictions of bodies, got more", Error);
  const std::string balls = many_bodies(1000, "<freejoint/><geom size='.1'/>");
  CHECK(limited_scene(balls + "<keyframe>" + repeated_text(5, "<key/>") + "</keyframe>")
            .keyframes.size() == 5);
  CHECK_THROWS_WITH_AS(
      limited_scene(balls + "<keyframe>" + repeated_text(600, "<key/>") + "</keyframe>"),
      "m.xml:1: key: expected at most 4000000 numbers in all keyframes, of 7000 each", Error);
}

TEST_CASE("elements of one kind in a class are limited, and the last of them counts") {
  const std::string ball = "<worldbody><body><freejoint/><geom/></body></worldbody>";
  const WorldSpec world = limited_scene(
      "<default>" + repeated_text(10, "<geom size='1.%' mass='%'/>") + "</default>" + ball);
  CHECK(world.bodies.front().body.mass == doctest::Approx(9));
  CHECK_THROWS_WITH_AS(
      limited_scene("<default>" + repeated_text(11, "<geom size='1'/>") + "</default>" + ball),
      "m.xml:1: default: expected at most 10 elements <geom> in one class", Error);
}

TEST_CASE("joints that actuators pull are limited in all") {
  const std::string arm =
      "<worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody><tendon><fixed "
      "name='t'>" +
      repeated_text(3000, "<joint joint='j' coef='1'/>") + "</fixed></tendon><actuator>";
  CHECK(limited_scene(arm + "<motor tendon='t'/></actuator>").robots.size() == 1);
  CHECK_THROWS_WITH_AS(
      limited_scene(arm + repeated_text(70, "<motor tendon='t'/>") + "</actuator>"),
      "m.xml:1: motor: expected actuators that pull at most 200000 joints, each counted once per "
      "actuator",
      Error);
}

TEST_CASE("what attaches itself is named") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "m.xml",
      "<mujoco><asset><model name='m' file='m.xml'/></asset><worldbody><attach model='m' "
      "prefix='p'/><body name='q'/></worldbody></mujoco>");
  CHECK_THROWS_WITH_AS(read_world(file, {}), "m.xml:1: model: 'm.xml' attaches itself", Error);
  folder.write("a.xml",
               "<mujoco><asset><model name='b' file='b.xml'/></asset><worldbody><attach model='b' "
               "prefix='p'/></worldbody></mujoco>");
  const auto circle = folder.write(
      "b.xml",
      "<mujoco><asset><model name='a' file='a.xml'/></asset><worldbody><attach model='a' "
      "prefix='p'/></worldbody></mujoco>");
  CHECK_THROWS_WITH_AS(read_world(circle, {}), "a.xml:1: model: 'b.xml' attaches itself", Error);
  CHECK_THROWS_WITH_AS(
      limited_scene("<worldbody><body name='q'><attach body='q' prefix='p'/></body></worldbody>"),
      "m.xml:1: attach: body 'q' attaches itself", Error);
}

TEST_CASE("a parameter of a built-in mesh is named once, and their triangles are limited") {
  const auto mesh = [](const std::string& params) {
    return "<asset>" +
           repeated_text(3, "<mesh name='m%' builtin='supersphere' params='" + params + "'/>") +
           "</asset><worldbody><body><freejoint/>" +
           repeated_text(3, "<geom type='mesh' mesh='m%'/>") + "</body></worldbody>";
  };
  CHECK_THROWS_WITH_AS(limited_scene(mesh("nan 1 1")),
                       "m.xml:1: mesh: params: expected a number, got 'nan'", Error);
  CHECK(limited_scene(mesh("20 1 1")).bodies.size() == 1);
  CHECK_THROWS_WITH_AS(limited_scene(mesh("300 1 1")),
                       "m.xml:1: mesh: builtin: expected at most 500000 triangles in all built-in "
                       "meshes",
                       Error);
}

TEST_CASE("round shapes of all links have a limited number of triangles") {
  const auto link = [](size_t count) {
    const TemporaryFolder folder;
    return ToldRobot(folder.write(
        "r.urdf", "<robot name='r'><link name='a'>" +
                      repeated_text(count,
                                    "<collision><origin xyz='% 0 0'/><geometry><sphere radius='1'/>"
                                    "</geometry></collision>") +
                      "</link></robot>"));
  };
  CHECK(link(10).robot.base.shape);
  CHECK_THROWS_WITH_AS(link(600),
                       "r.urdf: link 'a': expected at most 500000 triangles in the spheres, "
                       "capsules, cylinders and ellipsoids of all links, a thousand in each sphere",
                       Error);
}
