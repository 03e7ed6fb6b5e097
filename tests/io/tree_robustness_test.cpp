// URDF and MJCF files cut at any position, and files with parts exchanged at random, give a robot
// or an Error that names the file, never a crash or a hang.
#include <cmath>

#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "clench/spec/check_robot.h"
#include "support/mutate.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// No number of a robot that was read is NaN.
void check_sane(const RobotSpec& robot) {
  check_robot(robot);
  const auto check_body = [](const BodySpec& body) {
    CHECK(std::isfinite(body.mass));
    CHECK(body.mass > 0);
    if (body.com) CHECK(body.com->allFinite());
    if (body.inertia_per_mass) CHECK(body.inertia_per_mass->allFinite());
  };
  check_body(robot.base);
  for (const auto& link : robot.links) check_body(link.body);
  for (const auto& dof : robot.dofs) CHECK(std::isfinite(dof.default_velocity));
  if (robot.X_BA) CHECK(robot.X_BA->is_finite());
}

/// A folder with the files that the robots name.
class TreeBench {
 public:
  TreeBench() {
    for (const auto* name : {"finger.obj", "parts/finger.obj"})
      folder_.write(name, read_text("tests/data/urdf/finger.obj"));
    folder_.write("defaults.xml", read_text("tests/data/mjcf/defaults.xml"));
    options_.packages["gripper_description"] = folder_.path();
  }
  /// The same for a scene.
  bool scene_refused(const std::string& name, const std::string& text) {
    const fs::path file = folder_.write(name, text);
    try {
      const WorldSpec world = read_world(file, options_);
      for (const auto& placed : world.robots) check_sane(placed.robot);
      for (const auto& placed : world.bodies) {
        check_body(placed.body, "body");
        check_place(placed.X_WB, "body");
      }
      for (const auto& keyframe : world.keyframes)
        for (const auto& placed : keyframe.robots) {
          const RobotSpec& robot = world.robots.at(placed.robot).robot;
          CHECK(placed.dofs.size() == robot.dofs.size());
        }
      return false;
    } catch (const Error& error) {
      CHECK_MESSAGE(std::string(error.what()).starts_with(name), error.what());
      return true;
    }
  }
  /// returns  true if it was rejected   the test fails if the message names none of the files
  bool refused(const std::string& name, const std::string& text) {
    const fs::path file = folder_.write(name, text);
    try {
      check_sane(read_robot(file, options_));
      return false;
    } catch (const Error& error) {
      const std::string what = error.what();
      CHECK_MESSAGE((what.starts_with(name) || what.starts_with("defaults.xml")), what);
      return true;
    }
  }

 private:
  TemporaryFolder folder_;
  ReadOptions options_;
};

std::string urdf() { return read_text("tests/data/urdf/gripper.urdf"); }
std::string own() { return read_text("tests/data/urdf/own.urdf"); }
std::string scene() { return read_text("tests/data/mjcf/scene.xml"); }
std::string mjcf() { return read_text("tests/data/mjcf/hand.mjcf"); }

void cut_tree_everywhere(const std::string& name, const std::string& text) {
  TreeBench bench;
  for (size_t n = 0; n + 20 < text.size(); n += 41) CHECK(bench.refused(name, text.substr(0, n)));
}

/// A random change: a word or number within quotes, an element's name or a line is replaced by
/// another one from the text, or by an odd one.
std::string changed(std::string s, Random& random) {
  static const char* const odd[] = {"",      "nan",   "-1",   "0",    "1e15",       "1e-300",
                                    "a b c", "0 0 0", "1e99", "palm", "2147483648", "-0"};
  const int changes = 1 + static_cast<int>(random.bits() % 3);
  for (int i = 0; i < changes; ++i) {
    std::vector<std::pair<size_t, size_t>> values;  // between quotes
    for (size_t a = s.find('"'); a != std::string::npos; a = s.find('"', a + 1)) {
      const size_t b = s.find('"', a + 1);
      if (b == std::string::npos) break;
      values.emplace_back(a + 1, b);
      a = b;
    }
    if (values.size() < 2) return s;
    const auto [a, b] = values[random.bits() % values.size()];
    switch (random.bits() % 6) {
      case 0: {
        const auto [c, d] = values[random.bits() % values.size()];
        s.replace(a, b - a, s.substr(c, d - c));
        break;
      }
      case 1:
        s.replace(a, b - a, odd[random.bits() % std::size(odd)]);
        break;
      case 2: {  // deletes a line
        const size_t end = s.find('\n', a);
        const size_t begin = s.rfind('\n', a);
        if (begin != std::string::npos && end != std::string::npos) s.erase(begin, end - begin);
        break;
      }
      case 3: {  // repeats a line
        const size_t end = s.find('\n', a), begin = s.rfind('\n', a);
        if (begin != std::string::npos && end != std::string::npos)
          s.insert(begin, s.substr(begin, end - begin));
        break;
      }
      case 4:
        s[random.bits() % s.size()] = static_cast<char>(random.bits());
        break;
      default: {  // scales a number
        const auto value = parse_number(trim(std::string_view(s).substr(a, b - a)));
        if (value)
          s.replace(a, b - a, fmt::format("{}", *value * (random.uniform() < 0.5 ? -3 : 1e6)));
      }
    }
  }
  return s;
}

void change_tree_at_random(const std::string& name, const std::string& text, int times) {
  TreeBench bench;
  int refused = 0;
  for (int i = 0; i < times; ++i) {
    Random random(17, static_cast<uint64_t>(i));
    const std::string bad = changed(text, random);
    INFO(bad);
    refused += bench.refused(name, bad);
  }
  // some changes are harmless, others are not
  CHECK(refused > times / 10);
  CHECK(refused < times);
}

}  // namespace

TEST_CASE("the robots of this file are sound") {
  TreeBench bench;
  CHECK_FALSE(bench.refused("a.urdf", urdf()));
  CHECK_FALSE(bench.refused("a.xml", mjcf()));
  CHECK_FALSE(bench.refused("a.urdf", own()));
  CHECK_FALSE(bench.scene_refused("a.xml", scene()));
}
TEST_CASE("a URDF with an element of ours, changed at random, is an Error or a robot") {
  change_tree_at_random("a.urdf", own(), 400);
}
TEST_CASE("a scene changed at random is an Error or a world") {
  TreeBench bench;
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    Random random(23, static_cast<uint64_t>(i));
    const std::string bad = changed(scene(), random);
    INFO(bad);
    refused += bench.scene_refused("a.xml", bad);
  }
  CHECK(refused > 40);
  CHECK(refused < 400);
}
TEST_CASE("a URDF file cut short anywhere is an Error") { cut_tree_everywhere("a.urdf", urdf()); }
TEST_CASE("an MJCF file cut short anywhere is an Error") { cut_tree_everywhere("a.mjcf", mjcf()); }
TEST_CASE("a URDF file changed at random is an Error or a robot") {
  change_tree_at_random("a.urdf", urdf(), 300);
}
TEST_CASE("an MJCF file changed at random is an Error or a robot") {
  change_tree_at_random("a.mjcf", mjcf(), 300);
}
TEST_CASE("noise is an Error in formats of robot trees") {
  TreeBench bench;
  for (uint64_t i = 0; i < 40; ++i) {
    Random random(19, i);
    const std::string noise = test::noise(random);
    CHECK(bench.refused("a.urdf", noise));
    CHECK(bench.refused("a.mjcf", noise));
  }
}
