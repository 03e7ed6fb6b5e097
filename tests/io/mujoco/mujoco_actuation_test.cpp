// Actuators, joint dynamics and collision filters of MJCF files, compared with MuJoCo.
#include <doctest/doctest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "../temporary.h"
#include "clench/base/random.h"
#include "clench/io/read/read.h"
#include "clench/model/world.h"
#include "support/listening.h"
#include "support/mujoco.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

using Model = test::MujocoModel;

Model load(const fs::path& file) {
  std::array<char, 1000> error = {};
  Model model(mj_loadXML(file.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  INFO(std::string(error.data()));
  REQUIRE(model);
  return model;
}

std::string name_of(const mjModel& m, int type, int id) {
  const char* name = mj_id2name(&m, type, id);
  return name ? name : "";
}

WorldSpec read_quietly(const fs::path& file) {
  ReadOptions options;
  options.diagnostics =
      test::Listening{.warn = [](const std::string&) {}, .note = [](const std::string&) {}};
  return read_world(file, options);
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b)); }

// --- actuators ---

const ActuatorSpec* actuator_of(const WorldSpec& world, const std::string& name) {
  for (const PlacedRobot& placed : world.robots)
    for (const ActuatorSpec& actuator : placed.robot.actuators)
      if (actuator.name == name) return &actuator;
  return nullptr;
}

void check_actuators(const mjModel& m, const WorldSpec& world) {
  for (int a = 0; a < m.nu; ++a) {
    const std::string name = name_of(m, mjOBJ_ACTUATOR, a);
    CAPTURE(name);
    const ActuatorSpec* ours = actuator_of(world, name);
    REQUIRE(ours);
    const bool on_joint = m.actuator_trntype[a] == mjTRN_JOINT;
    CHECK((on_joint ? ours->joint : ours->tendon) ==
          name_of(m, on_joint ? mjOBJ_JOINT : mjOBJ_TENDON, m.actuator_trnid[2 * a]));
    CHECK(near(ours->gear, m.actuator_gear[6 * a]));
    CHECK(near(ours->gain, m.actuator_gainprm[mjNGAIN * a]));
    const bool affine = m.actuator_biastype[a] == mjBIAS_AFFINE;
    for (int k = 0; k < 3; ++k)
      CHECK(near(ours->bias[k], affine ? m.actuator_biasprm[mjNBIAS * a + k] : 0));
    const auto check_range = [](const auto& range, bool limited, const mjtNum* theirs) {
      REQUIRE(range.has_value() == limited);
      if (limited) CHECK((near((*range)[0], theirs[0]) && near((*range)[1], theirs[1])));
    };
    check_range(ours->control_range, m.actuator_ctrllimited[a], m.actuator_ctrlrange + 2 * a);
    check_range(ours->force_range, m.actuator_forcelimited[a], m.actuator_forcerange + 2 * a);
  }
}

const JointSpec* joint_of(const WorldSpec& world, const std::string& name) {
  for (const PlacedRobot& placed : world.robots)
    for (const LinkSpec& link : placed.robot.links)
      for (const JointSpec& joint : link.joints)
        if (joint.name == name) return &joint;
  return nullptr;
}

void check_joints(const mjModel& m, const WorldSpec& world) {
  for (int j = 0; j < m.njnt; ++j) {
    if (m.jnt_type[j] != mjJNT_HINGE && m.jnt_type[j] != mjJNT_SLIDE) continue;
    const std::string name = name_of(m, mjOBJ_JOINT, j);
    CAPTURE(name);
    const JointSpec* ours = joint_of(world, name);
    REQUIRE(ours);
    const int dof = m.jnt_dofadr[j];
    CHECK(ours->viscous == doctest::Approx(m.dof_damping[dof]).epsilon(1e-9));
    CHECK(near(ours->coulomb, m.dof_frictionloss[dof]));
    CHECK(near(ours->armature, m.dof_armature[dof]));
    CHECK(ours->spring == doctest::Approx(m.jnt_stiffness[j]).epsilon(1e-9));
    CHECK(near(ours->rest, m.qpos_spring[m.jnt_qposadr[j]]));
  }
}

/// An element of a default class, or an actuator, with random attributes; only those that MuJoCo
/// 2.2 treats like 3.
std::string actuator_attributes(Random& random, const std::string& kind) {
  const auto number = [&](double low, double high) {
    return fmt::format("{:.3f}", random.uniform(low, high));
  };
  std::string out;
  if (random.uniform() < 0.3) out += " gear='" + number(-3, 3) + "'";
  if (random.uniform() < 0.3) out += " ctrlrange='-" + number(0.1, 1) + " " + number(0.1, 1) + "'";
  if (random.uniform() < 0.3) out += " forcerange='-" + number(1, 9) + " " + number(1, 9) + "'";
  if (random.uniform() < 0.2) out += " ctrllimited='false'";
  if (kind == "position" && random.uniform() < 0.6) out += " kp='" + number(1, 50) + "'";
  if (kind == "velocity" && random.uniform() < 0.6) out += " kv='" + number(1, 50) + "'";
  if (kind == "general" && random.uniform() < 0.6) out += " gainprm='" + number(1, 50) + "'";
  if (kind == "general" && random.uniform() < 0.6)
    out += " biastype='affine' biasprm='" + number(-1, 1) + " -" + number(1, 50) + " -" +
           number(0, 3) + "'";
  return out;
}

std::string random_actuators(Random& random) {
  const std::array<std::string, 4> kinds = {"general", "motor", "position", "velocity"};
  const auto kind = [&] { return kinds[random.bits() % kinds.size()]; };
  // classes use one kind of law: if a <position> follows a <general>, 2.2 clears values that 3
  // keeps
  const auto element = [&](const std::string& k, const std::string& more) {
    return "<" + k + more + actuator_attributes(random, k) + "/>";
  };
  const std::string outer = kind(), inner = random.uniform() < 0.5 ? outer : "motor";
  std::string joints, actuators;
  for (int i = 0; i < 8; ++i) {
    joints += fmt::format(
        "<body name='b{0}' pos='{0} 0 0'><joint name='j{0}' {1} damping='{2:.2f}'/>"
        "<geom size='0.1'/></body>",
        i, random.uniform() < 0.5 ? "range='-50 90'" : "class='c'", random.uniform());
    const std::string own = random.uniform() < 0.5 ? inner : "motor";
    actuators += element(own, fmt::format(" name='a{0}' joint='j{0}' class='{1}'", i,
                                          random.uniform() < 0.6 ? "c" : "main"));
  }
  return "<mujoco><compiler autolimits='true'/><default>" + element(outer, "") +
         "<default class='c'><joint frictionloss='0.3' armature='0.2' stiffness='2' "
         "springref='20'/>" +
         element(inner, "") + "</default></default><worldbody><body name='base'>" +
         "<geom size='0.1'/>" + joints + "</body></worldbody><actuator>" + actuators +
         "</actuator></mujoco>";
}

// --- collisions ---

using Names = std::set<std::pair<std::string, std::string>>;

std::pair<std::string, std::string> in_order(std::string a, std::string b) {
  if (b < a) std::swap(a, b);
  return {a, b};
}

/// Pairs of bodies that MuJoCo finds in contact; all bodies overlap. A geom of the world is treated
/// as a body.
Names pairs_of_mujoco(const mjModel& m) {
  const test::MujocoData data(mj_makeData(&m));
  mj_kinematics(&m, data.get());
  mj_comPos(&m, data.get());
  mj_collision(&m, data.get());
  Names out;
  for (int i = 0; i < data->ncon; ++i) {
    std::string names[2];
    const int geoms[2] = {data->contact[i].geom1, data->contact[i].geom2};
    for (int k = 0; k < 2; ++k) {
      const int body = m.geom_bodyid[geoms[k]];
      names[k] = body == 0 ? name_of(m, mjOBJ_GEOM, geoms[k]) : name_of(m, mjOBJ_BODY, body);
    }
    out.insert(in_order(names[0], names[1]));
  }
  return out;
}

/// Pairs that may collide in our world, in which no pairs are disabled because of overlaps.
Names pairs_of_ours(const WorldSpec& spec) {
  World world;
  for (const OwnFriction& own : spec.frictions) world.add_friction(own);
  std::vector<Id<Body>> bodies(spec.bodies.size());
  std::vector<Id<Robot>> robots(spec.robots.size());
  std::map<Id<Body>, std::string> names;
  for (const WorldEntry& entry : spec.order) {
    if (entry.kind == WorldEntry::Kind::body) {
      const PlacedBody& placed = spec.bodies[entry.index];
      bodies[entry.index] = world.add_body(
          placed.body, placed.role == Role::object ? BodyKind::object : BodyKind::obstacle,
          placed.X_WB);
      names[bodies[entry.index]] = placed.body.name;
      continue;
    }
    const PlacedRobot& placed = spec.robots[entry.index];
    robots[entry.index] = world.add_robot(placed.robot, placed.X_WB);
    const auto ids = world.bodies_of(robots[entry.index]);
    for (size_t i = 0; i < ids.size(); ++i) {
      const BodySpec& part = i == 0 ? placed.robot.base : placed.robot.links[i - 1].body;
      names[ids[i]] = part.name.substr(placed.robot.name.size() + 1);
    }
  }
  const auto part = [&](const PartRef& ref) {
    return ref.kind == WorldEntry::Kind::body ? bodies[ref.index]
                                              : world.robot(robots[ref.index]).body_of(ref.link);
  };
  for (const auto& [a, b] : spec.never_meet) world.set_collision(false, part(a), part(b));
  for (const auto& [ref, bits] : spec.collision_bits) world.set_collision_bits(part(ref), bits);
  for (const auto& [a, b] : spec.always_meet) world.set_collision(true, part(a), part(b));
  Names out;
  for (const auto& [a, name_a] : names)
    for (const auto& [b, name_b] : names)
      if (a < b && world.body(a).shape && world.body(b).shape && world.may_collide(a, b))
        out.insert(in_order(name_a, name_b));
  return out;
}

/// The bodies to which bodies are fixed, or the bodies themselves; "" for the world.
std::map<std::string, std::string> pieces_of(const mjModel& m) {
  std::map<std::string, std::string> out;
  for (int b = 1; b < m.nbody; ++b)
    out[name_of(m, mjOBJ_BODY, b)] =
        m.body_weldid[b] ? name_of(m, mjOBJ_BODY, m.body_weldid[b]) : "";
  for (int g = 0; g < m.ngeom; ++g)
    if (m.geom_bodyid[g] == 0) out[name_of(m, mjOBJ_GEOM, g)] = "";
  return out;
}

/// Many overlapping balls: free, fixed, hinged, with random bits, pairs and exclusions.
std::string random_balls(Random& random) {
  const auto one_of = [&](int count) { return static_cast<int>(random.bits() % count); };
  int geoms = 0, bodies = 0;
  const auto geom = [&] {
    return fmt::format("<geom name='g{}' size='1' contype='{}' conaffinity='{}'/>", geoms++,
                       one_of(4), one_of(4));
  };
  std::function<std::string(int)> body = [&](int depth) {
    std::string out = fmt::format("<body name='b{}' pos='{:.2f} {:.2f} 0'>", bodies++,
                                  random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    // a body fixed to a free body becomes part of it, without separate names
    if (depth == 0 && random.uniform() < 0.3)
      return out + "<freejoint/>" + geom() + (one_of(2) ? geom() : "") + "</body>";
    if (random.uniform() < 0.6) out += "<joint range='-9 9'/>";
    const int own = 1 + one_of(2);
    for (int i = 0; i < own; ++i) out += geom();
    for (int i = depth < 3 ? one_of(3) : 0; i > 0; --i) out += body(depth + 1);
    return out + "</body>";
  };
  std::string inside = geom() + geom();
  for (int i = 0; i < 3; ++i) inside += body(0);
  // if one joint is driven, closing directions of the others are not guessed, which would take time
  inside += "<body name='driven'><joint name='m'/>" + geom() + "</body>";
  std::string contact;
  for (int i = 0; i < 3; ++i) {
    const int a = one_of(bodies), b = one_of(bodies);
    if (a != b) contact += fmt::format("<exclude body1='b{}' body2='b{}'/>", a, b);
  }
  contact += fmt::format("<exclude body1='world' body2='b{}'/>", one_of(bodies));
  return "<mujoco><compiler autolimits='true'/><size nconmax='3000' njmax='100'/><option>"
         "<flag constraint='enable'" +
         std::string(one_of(4) == 0 ? " filterparent='disable'" : "") + "/></option><worldbody>" +
         inside + "</worldbody><contact>" + contact +
         "</contact><actuator><motor joint='m'/></actuator></mujoco>";
}

}  // namespace

TEST_CASE("actuators and joints of random classes are those of MuJoCo") {
  TemporaryFolder folder;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    Random random(49, seed);
    const std::string text = random_actuators(random);
    CAPTURE(text);
    const fs::path file = folder.write("m.xml", text);
    const Model model = load(file);
    const WorldSpec world = read_quietly(file);
    check_actuators(*model, world);
    check_joints(*model, world);
  }
}

TEST_CASE("pairs of bodies that may collide are those of MuJoCo") {
  TemporaryFolder folder;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    Random random(50, seed);
    const std::string text = random_balls(random);
    CAPTURE(text);
    const fs::path file = folder.write("m.xml", text);
    const Model model = load(file);
    const auto pieces = pieces_of(*model);
    // bodies fixed to each other cannot move relative to each other
    const auto moves = [&](const auto& pair) {
      return pieces.at(pair.first) != pieces.at(pair.second);
    };
    Names ours, theirs;
    for (const auto& pair : pairs_of_ours(read_quietly(file)))
      if (moves(pair)) ours.insert(pair);
    for (const auto& pair : pairs_of_mujoco(*model))
      if (moves(pair)) theirs.insert(pair);
    CHECK(ours == theirs);
  }
}

TEST_CASE("a pair collides independently of bits, parents and exclusions, as in MuJoCo") {
  TemporaryFolder folder;
  const fs::path file = folder.write("m.xml", R"(<mujoco><compiler autolimits="true"/><worldbody>
<geom name="floor" size="1" contype="0" conaffinity="0"/>
<body name="free"><freejoint/><geom name="f" size="1" contype="0" conaffinity="0"/></body>
<body name="a"><freejoint/><geom name="ga" size="1"/><body name="b"><joint range="-9 9"/><geom name="gb" size="1"/>
<body name="c"><joint range="-9 9"/><geom name="gc" size="1"/></body></body></body></worldbody>
<contact><pair geom1="f" geom2="floor"/><pair geom1="ga" geom2="gb"/><pair geom1="gc" geom2="ga"/>
<exclude body1="a" body2="c"/></contact></mujoco>)");
  CHECK(pairs_of_mujoco(*load(file)) == Names{{"floor", "free"}, {"a", "b"}, {"a", "c"}});
  CHECK(pairs_of_ours(read_quietly(file)) == Names{{"floor", "free"}, {"a", "b"}, {"a", "c"}});
}

TEST_CASE("springs and dampers of a time constant are those of MuJoCo") {
  TemporaryFolder folder;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(51, seed);
    const auto triple = [&] {
      return fmt::format("{:.3f} {:.3f} {:.3f}", random.uniform(-1, 1), random.uniform(-1, 1),
                         random.uniform(0.1, 1));
    };
    std::string text = "<mujoco><worldbody><body name='base'><geom size='0.1'/>";
    for (int i = 0; i < 4; ++i)
      text += fmt::format(
          "<body pos='{}' euler='{}'><joint name='j{}' type='{}' pos='{}' axis='{}' "
          "armature='{:.3f}' springdamper='{:.3f} {:.3f}'/><geom type='box' size='.1 .2 .3' "
          "pos='{}'/>",
          triple(), triple(), i, random.uniform() < 0.3 ? "slide" : "hinge", triple(), triple(),
          random.uniform(), random.uniform(0.1, 1), random.uniform(0.1, 2), triple());
    text += "</body></body></body></body></body></worldbody></mujoco>";
    CAPTURE(text);
    const fs::path file = folder.write("m.xml", text);
    check_joints(*load(file), read_quietly(file));
  }
}
