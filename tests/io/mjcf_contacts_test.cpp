// Collisions of MJCF files: bits, pairs, exclusions, parent bodies, and switches of the simulation.
#include "clench/io/mjcf/mjcf.h"
#include "support/listening.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using namespace clench::test;

namespace {

ToldRobot linked_bodies(const std::string& base, const std::string& bits = "",
                        const std::string& rest = "") {
  TemporaryFolder folder;
  return ToldRobot(
      folder.write("m.xml", "<mujoco model='m'><worldbody><body name='base'>" + base +
                                "<geom name='g' size='1' " + bits +
                                "/><body name='a'><joint name='j'/><geom name='h' size='1' " +
                                bits + "/></body></body></worldbody>" + rest + "</mujoco>"));
}

struct ContactWorld {
  Warnings told;
  std::vector<std::string> notes;
  WorldSpec world;

  explicit ContactWorld(const std::string& text) {
    TemporaryFolder folder;
    ReadOptions options = told.options();
    options.diagnostics =
        Listening{.warn = [before = options.diagnostics](
                              const std::string& sentence) { before.warn(Diagnostic(sentence)); },
                  .note = [this](const std::string& s) { notes.push_back(s); }};
    world = read_world(folder.write("m.xml", "<mujoco>" + text + "</mujoco>"), options);
  }
  bool warned(const std::string& part) const { return ToldRobot::has(told.list, part); }
  bool noted(const std::string& part) const { return ToldRobot::has(notes, part); }
};

using Pairs = std::vector<std::array<int, 2>>;

const std::string ball_xml =
    "<worldbody><body name='ball'><freejoint/><geom size='1'/></body></worldbody>";

}  // namespace

TEST_CASE("a link collides with its parent if that is fixed to the world") {
  CHECK(linked_bodies("").robot.collision_rules.pairs_on == Pairs{{-1, 0}});
  CHECK(linked_bodies("<freejoint/>").robot.collision_rules.pairs_on.empty());
  // a moving link and its parent never collide, regardless of bodies fixed to them
  TemporaryFolder folder;
  const ToldRobot told(folder.write("m.xml", R"(<mujoco><worldbody><body name='base'>
<body name='a'><joint name='j'/><geom size='1'/><body name='b'><geom size='1'/>
<body name='c'><joint name='k'/><geom size='1'/></body></body></body></body></worldbody></mujoco>)"));
  CHECK(told.robot.collision_rules.pairs_on.empty());
  CHECK(told.robot.collision_rules.pairs_off == Pairs{{0, 2}});
}

TEST_CASE("geoms without bits collide with nothing") {
  const ToldRobot told = linked_bodies("", "contype='0' conaffinity='0'");
  CHECK_FALSE(told.body("a").shape);
  CHECK(told.body("a").appearance.visual);
  CHECK(told.noted("m.xml: nothing collides because of contype and conaffinity"));
}

TEST_CASE("pairs collide though nothing else lets them") {
  const ToldRobot told = linked_bodies("<freejoint/>", "contype='0' conaffinity='0'",
                                       "<contact><pair geom1='h' geom2='g'/></contact>");
  CHECK(told.body("a").shape);
  CHECK(told.robot.collision_rules.pairs_on == Pairs{{-1, 0}});
  CHECK(told.robot.collision_rules.pairs_off.empty());
  CHECK(linked_bodies("", "", "<contact><pair geom1='h' geom2='x'/></contact>")
            .warned("pairs of which a geom is not read are not used: 'h' and 'x'"));
  CHECK(linked_bodies("", "", "<contact><pair geom1='h' geom2='g' friction='1 1 1 1 1'/></contact>")
            .warned("friction and condim of pairs are not used; those of the geoms count: 'h' and "
                    "'g'"));
  // each body is one surface
  const ToldRobot mixed = linked_bodies("<geom size='1' contype='2' conaffinity='2'/>");
  CHECK(
      mixed.warned("let only some geoms of these bodies collide; here all of them do: 'base' and "
                   "'a'"));
}

TEST_CASE("bodies may be excluded from colliding with the world") {
  const ContactWorld told(
      "<worldbody><geom name='x' size='1'/><geom name='y' size='1'/><body name='ball'><freejoint/>"
      "<geom size='1'/></body></worldbody><contact><exclude body1='ball' "
      "body2='world'/></contact>");
  CHECK(told.world.never_meet.size() == 2);
  // and the two bodies of the world are fixed
  CHECK(told.world.collision_bits.size() == 3);
  CHECK(told.told.list.empty());
}

TEST_CASE("switches of the simulation are followed or warned of by name") {
  const auto flags = [](const std::string& text) {
    return ContactWorld("<option gravity='0 0 -5'><flag " + text + "/></option>" + ball_xml);
  };
  const ContactWorld off = flags("gravity='disable' contact='disable'");
  CHECK(off.world.gravity->isZero());
  CHECK_FALSE(off.world.collision_on);
  CHECK(off.told.list.empty());
  CHECK(off.noted("the file disables contacts"));
  const ContactWorld idle = flags("contact='enable' warmstart='disable' energy='enable'");
  CHECK(idle.told.list.empty());
  CHECK(idle.noted("m.xml:1: flag: settings of MuJoCo's solver are not used: warmstart, energy"));
  CHECK(flags("contact='enable'").world.collision_on);
  const ContactWorld lost = flags("gravity='disable' limit='disable' override='enable'");
  CHECK(lost.warned("m.xml:1: flag: not used: limit=\"disable\", override=\"enable\""));
  const ContactWorld all = flags("constraint='disable'");
  CHECK_FALSE(all.world.collision_on);
  CHECK(all.warned("constraint=\"disable\""));
}

TEST_CASE("parents collide if their filter is off, independently of later flags") {
  TemporaryFolder folder;
  for (const char* more : {"", "<flag contact='enable'/>"}) {
    const ToldRobot told(folder.write(
        "m.xml", fmt::format(R"(<mujoco><option><flag filterparent='disable'/>{}</option>
<worldbody><body name='base'><freejoint/><geom size='1'/><body name='a'><joint name='j'/><geom size='1'/></body></body>
</worldbody></mujoco>)",
                             more)));
    CHECK(told.robot.collision_rules.pairs_on == Pairs{{-1, 0}});
  }
}

TEST_CASE("replicas without contents count as elements") {
  CHECK_THROWS_WITH(ContactWorld("<worldbody><replicate count='2000000000'/></worldbody>"),
                    "m.xml:1: expected at most 100000 elements made by replicate and attach");
}
