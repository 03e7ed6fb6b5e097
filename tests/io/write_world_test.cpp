#include "clench/io/write/write_world.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/read/read.h"
#include "support/listening.h"
#include "support/meshes.h"
#include "support/plain_user.h"
#include "support/shapes.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

static const fs::path library = "tests/data/two_finger";

/// Two robots, the second carried by the first, three bodies, a camera; all at arbitrary poses.
static WorldSpec any_world(uint64_t seed) {
  Random random(5, seed);
  ReadOptions options;
  WorldSpec world = read_world(library / "claw.wld", options);
  world.robots.push_back(world.robots[0]);
  world.bodies.push_back(world.bodies[0]);
  world.order.insert(world.order.begin(), {WorldEntry::Kind::robot, 1});
  // blocks are counted in their order
  for (auto& entry : world.order)
    if (entry.kind == WorldEntry::Kind::robot) entry.index = &entry == &world.order[0] ? 0 : 1;
  world.order.push_back({WorldEntry::Kind::body, static_cast<int>(world.bodies.size()) - 1});
  for (auto& placed : world.bodies) placed.X_WB = test::random_pose(random, 2);
  for (auto& placed : world.robots) {
    placed.X_WB = test::random_pose(random, 2);
    for (double& q : placed.dofs) q = random.uniform(0, 0.05);
    for (JointPosition& joint : placed.joint_positions) {
      joint.reset();
      if (random.uniform(0, 1) < 0.5) joint = random.uniform(0, 0.01);
    }
  }
  Connection c;
  c.child = 1;
  c.link = static_cast<int>(world.robots[0].robot.links.size()) - 1;
  c.X_LB = test::random_pose(random, 2);
  if (seed % 2) c.mount = world.bodies[0].body;
  world.connections.push_back(c);
  world.camera = Camera{test::random_pose(random, 2), random.uniform(0.1, 2)};
  return world;
}

/// One rounding of a length from meters to millimeters and one back.
static constexpr double world_rounding = 1e-15;

static double gap(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() +
         (a.rotation.coeffs() - b.rotation.coeffs()).cwiseAbs().maxCoeff();
}

static void check_same(const WorldSpec& a, const WorldSpec& b, double tolerance) {
  REQUIRE(a.order.size() == b.order.size());
  for (size_t i = 0; i < a.order.size(); ++i) {
    CHECK(a.order[i].kind == b.order[i].kind);
    CHECK(a.order[i].index == b.order[i].index);
  }
  for (size_t i = 0; i < a.bodies.size(); ++i) {
    CHECK(a.bodies[i].role == b.bodies[i].role);
    CHECK(a.bodies[i].body.shape->hash() == b.bodies[i].body.shape->hash());
    CHECK(gap(a.bodies[i].X_WB, b.bodies[i].X_WB) <= tolerance);
  }
  for (size_t i = 0; i < a.robots.size(); ++i) {
    CHECK(gap(a.robots[i].X_WB, b.robots[i].X_WB) <= tolerance);
    REQUIRE(a.robots[i].dofs.size() == b.robots[i].dofs.size());
    for (size_t d = 0; d < a.robots[i].dofs.size(); ++d)
      CHECK(std::abs(a.robots[i].dofs[d] - b.robots[i].dofs[d]) <= tolerance);
    for (size_t j = 0; j < a.robots[i].joint_positions.size(); ++j) {
      const JointPosition &first = a.robots[i].joint_positions[j],
                          &second = b.robots[i].joint_positions[j];
      REQUIRE(first.has_value() == second.has_value());
      CHECK(std::abs(first.value_or(0) - second.value_or(0)) <= tolerance);
    }
  }
  for (size_t i = 0; i < a.connections.size(); ++i) {
    CHECK(gap(a.connections[i].X_LB, b.connections[i].X_LB) <= tolerance);
    CHECK(a.connections[i].mount.has_value() == b.connections[i].mount.has_value());
  }
  CHECK(gap(a.camera->X_WC, b.camera->X_WC) <= tolerance);
  CHECK(std::abs(a.camera->focal_distance - b.camera->focal_distance) <= tolerance);
}

TEST_CASE("a decimal in another unit is read back to the bit, and is no longer than it was") {
  Random random(3, 0);
  for (int i = 0; i < 2000; ++i) {
    const double unit = i % 3 ? 1e-3 : 1e-6, factor = i % 2 ? 1 : random.uniform(-3, 3);
    // as in a file, with few digits or all
    double written = random.uniform(-1000, 1000);
    if (i % 4 == 0) written = std::round(written * 100) / 100;
    const double value = written * unit * factor;
    const std::string text = number_in(value, unit, factor);
    CHECK(*parse_number(text) * unit * factor == value);
    CHECK(text.size() <= fmt::format("{}", written).size());
  }
  CHECK(number_in(0.17505, 1e-3) == "175.05");
  CHECK(number_in(0, 1e-3) == "0");
}

TEST_CASE("a value that no decimal gives to the bit is off by one rounding") {
  Random random(4, 0);
  for (int i = 0; i < 2000; ++i) {
    const double value = random.uniform(-2, 2);
    const double back = *parse_number(number_in(value, 1e-3)) * 1e-3;
    CHECK(std::abs(back - value) <= 2.3e-16 * std::abs(value));
  }
}

TEST_CASE("worlds of any content are read back, and to the bit from the second time on") {
  const TemporaryFolder folder;
  for (const std::string ending : {".wld", ".xml"})
    for (uint64_t seed = 0; seed < 12; ++seed) {
      INFO(ending << " " << seed);
      const WorldSpec world = any_world(seed);
      const fs::path first = folder.path() / ("first" + ending),
                     second = folder.path() / ("second" + ending);
      write_world(world, first);
      const WorldSpec once = read_world(first);
      check_same(world, once, world_rounding * 4);
      write_world(once, second);
      check_same(once, read_world(second), 0);
      CHECK(read_text(first) == read_text(second));
    }
}

TEST_CASE("files below the root are named from it, others whole, and each is found again") {
  const TemporaryFolder folder;
  const std::string box = "#Inventor V2.1 ascii\nCube { }\n";
  const fs::path inside = folder.write("lib/models/box.iv", box);
  const fs::path outside = folder.write("other/box.iv", box);
  WorldSpec world;
  for (const auto& path : {inside, outside}) {
    world.order.push_back({WorldEntry::Kind::body, static_cast<int>(world.bodies.size())});
    world.bodies.push_back({read_body(path), Role::object, {}});
  }
  const fs::path saved = folder.write("place/w.wld", "");
  write_world(world, saved, {.root = folder.path() / "lib"});
  CHECK(
      read_text(saved) ==
      "#GraspIt! version 2.0\nGraspableBody\nmodels/box.iv\nT (1 0 0 0)[0 0 0]\n\nGraspableBody\n" +
          outside.generic_string() + "\nT (1 0 0 0)[0 0 0]\n\n");
  ReadOptions rooted;
  rooted.root = folder.path() / "lib";
  CHECK(read_world(saved, rooted).bodies[0].body.file == inside.generic_string());

  // a decoy that would be found first requires the complete name
  folder.write("place/models/box.iv", "#Inventor V2.1 ascii\nSphere { }\n");
  write_world(world, saved, {.root = folder.path() / "lib"});
  CHECK(read_world(saved, rooted).bodies[0].body.file == inside.generic_string());

  // below the file's folder a name needs no root
  const fs::path near = folder.write("w.xml", "");
  write_world(world, near);
  CHECK(read_text(near).find("<filename>lib/models/box.iv</filename>") != std::string::npos);
  CHECK(read_world(near).bodies.size() == 2);
}

TEST_CASE("a body without a file is written beside, with all that the format holds") {
  const TemporaryFolder folder;
  BodySpec ball;
  ball.name = "my ball";
  ball.shape = Shape::make(test::ball(0.03, 5, 7), "ball");
  ball.material = "rubber";
  ball.mass = 0.123;
  ball.com = Eigen::Vector3d(0.001, 0.002, 0.003);
  ball.elastic_modulus = 1.5e6;
  ball.inertia_per_mass = Eigen::Vector3d(1e-4, 2e-4, 2.5e-4).asDiagonal();
  BodySpec frame;
  frame.name = "frame";
  WorldSpec world;
  world.order = {{WorldEntry::Kind::body, 0}, {WorldEntry::Kind::body, 1}};
  world.bodies = {{ball, Role::object, {}}, {frame, Role::obstacle, {}}};
  for (const std::string ending : {".wld", ".xml"}) {
    const fs::path saved = folder.path() / ("w" + ending);
    write_world(world, saved);
    const WorldSpec again = read_world(saved);
    const auto file = [&](const char* name) {
      int found = 0;
      for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "w_files"))
        found += entry.path().filename() == name;
      return found;
    };
    CHECK(file("my_ball.off") > 0);
    CHECK((file("my_ball.xml") > 0) == (ending == ".wld"));
    const BodySpec& b = again.bodies[0].body;
    CHECK(b.shape->hash() == ball.shape->hash());
    CHECK(b.material == "rubber");
    CHECK(b.mass == ball.mass);
    CHECK(*b.com == *ball.com);
    CHECK(*b.elastic_modulus == *ball.elastic_modulus);
    CHECK((*b.inertia_per_mass - *ball.inertia_per_mass).cwiseAbs().maxCoeff() < 1e-19);
    CHECK_FALSE(again.bodies[1].body.shape);
    CHECK(b.name == "my_ball");
    fs::remove_all(folder.path() / "w_files");
  }
}

TEST_CASE("a body whose file holds another surface now keeps its own, with a warning") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  WorldSpec world;
  world.order = {{WorldEntry::Kind::body, 0}};
  world.bodies = {{read_body(file), Role::object, {}}};
  folder.write("box.iv", "#Inventor V2.1 ascii\nSphere { }\n");
  std::vector<std::string> warnings;
  const fs::path saved = folder.path() / "w.xml";
  write_world(world, saved, {.diagnostics = test::Listening{.warn = [&](const std::string& s) {
                               warnings.push_back(s);
                             }}});
  CHECK(read_world(saved).bodies[0].body.shape->hash() == world.bodies[0].body.shape->hash());
  CHECK(warnings ==
        std::vector<std::string>{
            "w.xml: 'box' is saved with its triangles, for its file gives another surface when it "
            "is read again: " +
            file.generic_string()});
}

TEST_CASE("an older file stays until the new one is found good, and no draft is left") {
  const TemporaryFolder folder;
  const fs::path saved = folder.write("w.wld", "precious");
  const WorldSpec world = read_world(library / "claw.wld");
  bool seen = false;
  const auto check = [&](const fs::path& draft) {
    seen = read_world(draft).bodies.size() == world.bodies.size();
    CHECK(read_text(saved) == "precious");
    fail("no good");
  };
  CHECK_THROWS_WITH_AS(write_world(world, saved, {.check = check}),
                       "w.wld cannot be saved: no good", Error);
  CHECK(seen);
  CHECK(read_text(saved) == "precious");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("what cannot be written is refused in a sentence") {
  const TemporaryFolder folder;
  const WorldSpec world = read_world(library / "claw.wld");
  CHECK_THROWS_WITH_AS(write_world(world, folder.path() / "w.txt"),
                       "w.txt: expected the extension .xml, .mjcf, .wld or .lua, got '.txt'",
                       Error);
  CHECK_THROWS_WITH_AS(write_world(world, "no/such/w.wld"),
                       "no/such/w.wld: the file cannot be written: no such folder: no/such", Error);
  CHECK_THROWS_WITH_AS(write_world(world, folder.path() / "w.wld", {.root = "no/such"}),
                       "w.wld: root: expected a folder, got 'no/such'", Error);
  WorldSpec made = world;
  made.robots[0].robot.file.clear();
  CHECK_THROWS_WITH_AS(write_world(made, folder.path() / "w.wld"),
                       "robot 'claw' cannot be saved: it does not come from a file", Error);
  made.robots[0].robot.file = fs::absolute(library / "pincher.cfg").string();
  made.robots[0].robot.dofs.emplace_back();
  CHECK_THROWS_AS(write_world(made, folder.path() / "w.wld"), Error);
  made = world;
  made.robots[0].robot.file = (folder.path() / "gone.cfg").string();
  CHECK_THROWS_AS(write_world(made, folder.path() / "w.wld"), Error);
  const fs::path odd = folder.write("a\nb.iv", "#Inventor V2.1 ascii\nCube { }\n");
  made = world;
  made.bodies[0].body = read_body(odd);
  CHECK_THROWS_WITH_AS(write_world(made, folder.path() / "w.wld"),
                       "the name of a file cannot be written in a line of a .wld: 'a?b.iv'", Error);
  CHECK_NOTHROW(write_world(made, folder.path() / "w.xml"));
  made.bodies[0].body = read_body(folder.write("#a.iv", "#Inventor V2.1 ascii\nCube { }\n"));
  CHECK_THROWS_WITH_AS(write_world(made, folder.path() / "w.wld"),
                       "the name of a file cannot be written in a line of a .wld: '#a.iv'", Error);
  CHECK_NOTHROW(write_world(made, folder.path() / "w.xml"));
}

TEST_CASE("a save that fails leaves nothing behind, and what was there as it was") {
  const TemporaryFolder folder;
  WorldSpec world;
  world.bodies.emplace_back();
  world.bodies[0].body.name = "block";
  world.bodies[0].body.shape = Shape::make(test::box(1, 1, 1));
  world.order.push_back({WorldEntry::Kind::body, 0});
  fs::permissions(folder.path(), fs::perms(0777));
  for (const char* name : {"w.wld", "w.xml", "w.lua"}) {
    const fs::path older = folder.write(name, "older");
    fs::permissions(older, fs::perms(0444));
    {
      const test::PlainUser user;
      CHECK_THROWS_WITH_AS(
          write_world(world, older),
          (older.string() + ": the file cannot be written: Permission denied").c_str(), Error);
    }
    CHECK(read_text(older) == "older");
    const auto failing = [](const fs::path&) { fail("no"); };
    CHECK_THROWS_AS(
        write_world(world, folder.path() / ("new_" + std::string(name)), {.check = failing}),
        Error);
  }
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 3);
}

TEST_CASE("what is saved, or fails to be, changes no world that was saved before") {
  const TemporaryFolder folder;
  const auto world_with = [](double radius) {
    PlacedBody ball;
    ball.body.name = "ball";
    ball.body.shape = Shape::make(test::ball(radius), "ball");
    WorldSpec world;
    world.order = {{WorldEntry::Kind::body, 0}};
    world.bodies = {ball};
    return world;
  };
  const auto radius_in = [&](const char* name) {
    return read_world(folder.path() / name).bodies[0].body.shape->bounds().high.z();
  };
  write_world(world_with(0.03), folder.path() / "desk.wld");
  write_world(world_with(0.05), folder.path() / "desk.xml");
  CHECK(radius_in("desk.wld") == doctest::Approx(0.03).epsilon(1e-12));
  CHECK(radius_in("desk.xml") == doctest::Approx(0.05).epsilon(1e-12));
  WriteOptions refusing;
  refusing.check = [](const fs::path&) { fail("no"); };
  CHECK_THROWS_WITH_AS(write_world(world_with(0.07), folder.path() / "desk.wld", refusing),
                       "desk.wld cannot be saved: no", Error);
  CHECK(radius_in("desk.wld") == doctest::Approx(0.03).epsilon(1e-12));
}
