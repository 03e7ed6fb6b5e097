// Friction of pairs of geoms compared with MuJoCo's contacts.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "clench/base/random.h"
#include "clench/contact/materials.h"
#include "clench/io/read/read.h"
#include "support/folder.h"
#include "support/mujoco.h"

using namespace clench;
using namespace clench::test;

namespace {

/// Friction of the contact of two overlapping balls in MuJoCo; 0 without friction.
double mujoco_friction(const std::filesystem::path& path) {
  char error[1000] = "";
  const MujocoModel model(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
  REQUIRE_MESSAGE(model, error);
  const MujocoData data(mj_makeData(model.get()));
  mj_forward(model.get(), data.get());
  REQUIRE(data->ncon == 1);
  return data->contact[0].dim == 1 ? 0 : data->contact[0].friction[0];
}

}  // namespace

TEST_CASE("friction of a link on an object is that of MuJoCo's contact") {
  Random random(5);
  const TemporaryFolder folder;
  int frictionless = 0, by_priority = 0;
  for (int i = 0; i < 60; ++i) {
    std::string geoms[2];
    for (std::string& geom : geoms)
      geom = fmt::format("<geom size='1' friction='{:.3f}' priority='{:d}' condim='{}'/>",
                         random.uniform(0.01, 2), random.uniform() < 0.5,
                         random.uniform() < 0.5 ? 1 : 3);
    const auto path = folder.write(
        "m.xml", fmt::format("<mujoco><worldbody><body name='r'><joint name='j'/>{}</body>"
                             "<body name='o' pos='1.5 0 0'><freejoint/>{}</body></worldbody>"
                             "</mujoco>",
                             geoms[0], geoms[1]));
    const double theirs = mujoco_friction(path);
    // each separately, and both in a world
    ReadOptions options;
    options.body = "r";
    const RobotSpec robot = read_robot(path, options);
    const WorldSpec scene = read_world(path);
    MaterialTable table;
    for (const OwnFriction& own : robot.frictions) table.add(own);
    for (const OwnFriction& own : scene.frictions) table.add(own);
    const auto mu = table.friction(table.index(robot.links.at(0).body.material),
                                   table.index(scene.bodies.at(0).body.material));
    INFO(geoms[0] << geoms[1]);
    CHECK(mu.statics == doctest::Approx(theirs));
    CHECK(mu.kinetic == doctest::Approx(theirs));
    frictionless += theirs == 0;
    by_priority += geoms[0].find("priority='0'") != geoms[1].find("priority='0'");
  }
  CHECK(frictionless > 5);
  CHECK(by_priority > 10);
}
