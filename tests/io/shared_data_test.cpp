// Text models of GraspIt!, if installed, compared with values measured by GraspIt!
#include <algorithm>
#include <map>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "files_below.h"
#include "support/measured.h"
#include "support/shared.h"

using namespace clench;
using clench::test::files_below;
namespace fs = std::filesystem;

static fs::path root() { return test::shared() / "data/graspit"; }

static Eigen::Vector3d vector(const nlohmann::json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

/// The text file of the same body.
static fs::path text_file(std::string file) {
  if (file.ends_with(".xml")) file.replace(file.size() - 4, 4, ".iv");
  return root() / file;
}

static const std::vector<std::string> measured_worlds = {"dlr_flask", "plannerMug", "plannerP51",
                                                         "barrettGlassDyn"};

TEST_CASE("every body of the original loads, with triangles unless it is a frame") {
  REQUIRE_SHARED();
  const auto files = files_below(root() / "models", {".iv", ".wrl"});
  CHECK(files.size() > 100);
  int frames = 0;
  for (const auto& file : files) {
    INFO(file.string());
    BodySpec body;
    CHECK_NOTHROW(body = read_body(file));
    CHECK(body.mass > 0);
    if (!body.shape) ++frames;
  }
  CHECK(frames < 5);
}

TEST_CASE("every robot of the original loads") {
  REQUIRE_SHARED();
  const auto files = files_below(root() / "models/robots", {".cfg"});
  CHECK(files.size() >= 11);
  for (const auto& file : files) {
    INFO(file.string());
    RobotSpec robot;
    CHECK_NOTHROW(robot = read_robot(file));
    CHECK_FALSE(robot.dofs.empty());
    CHECK_FALSE(robot.links.empty());
    CHECK(robot.base.shape);
  }
}

TEST_CASE("every world of the original loads, with the root given and without") {
  REQUIRE_SHARED();
  ReadOptions options;
  options.root = root();
  for (const auto& file : files_below(root() / "worlds", {".wld"})) {
    INFO(file.string());
    WorldSpec with, without;
    CHECK_NOTHROW(with = read_world(file, options));
    CHECK_NOTHROW(without = read_world(file));
    CHECK(with.order.size() == without.order.size());
    CHECK(with.camera);
    for (const auto& placed : with.robots) CHECK(placed.dofs.size() == placed.robot.dofs.size());
  }
}

TEST_CASE("triangles, bounds, area, mass and material are those of the original") {
  REQUIRE_SHARED();
  std::map<std::string, nlohmann::json> bodies;
  for (const auto& name : measured_worlds) {
    const auto measured = test::measured("world_" + name);
    for (const auto& body : measured.at("bodies"))
      bodies[body.at("file").get<std::string>()] = body;
  }
  CHECK(bodies.size() > 20);
  for (const auto& [file, measured] : bodies) {
    INFO(file);
    const BodySpec body = read_body(text_file(file));
    REQUIRE(body.shape);
    CHECK(body.shape->mesh().triangles.size() == measured.at("triangles").get<size_t>());
    // GraspIt! multiplies 32-bit coordinates by matrices of doubles or of 32 bits: a unit in the
    // last place of a table's 1300 mm is 1e-4 mm
    const double size = body.shape->bounds().high.cwiseAbs().maxCoeff() * 1000;
    const double rounding =
        1e-9 + 2.5e-7 * std::max(size, body.shape->bounds().low.cwiseAbs().maxCoeff() * 1000);
    CHECK((body.shape->bounds().low * 1000 - vector(measured.at("bbox_local_min")))
              .cwiseAbs()
              .maxCoeff() < rounding);
    CHECK((body.shape->bounds().high * 1000 - vector(measured.at("bbox_local_max")))
              .cwiseAbs()
              .maxCoeff() < rounding);
    // one face of one arm link is not flat, and cut along another diagonal: 2e-8
    CHECK(body.shape->mesh().area() * 1e6 ==
          doctest::Approx(measured.at("mesh_area_mm2").get<double>()).epsilon(1e-7));
    CHECK(body.material == measured.at("material").get<std::string>());
    if (measured.contains("mass_g"))
      CHECK(body.mass * 1000 == doctest::Approx(measured.at("mass_g").get<double>()));
    if (measured.contains("cog") && body.com)
      CHECK((*body.com * 1000 - vector(measured.at("cog"))).norm() < 1e-9);
  }
}

TEST_CASE("poses, DOFs and approach frames are those of the original") {
  REQUIRE_SHARED();
  for (const auto& name : measured_worlds) {
    INFO(name);
    const auto measured = test::measured("world_" + name);
    const WorldSpec world = read_world(root() / "worlds" / (name + ".wld"));
    for (size_t i = 0; i < world.bodies.size(); ++i) {
      const auto& pose = measured.at("bodies").at(i).at("pose");
      const auto& q = pose.at("q_wxyz");
      const Eigen::Quaterniond rotation(q.at(0), q.at(1), q.at(2), q.at(3));
      CHECK((world.bodies[i].X_WB.position * 1000 - vector(pose.at("t"))).norm() < 1e-9);
      CHECK(world.bodies[i].X_WB.rotation.angularDistance(rotation) <
            1e-7);  // acos near 1 halves the digits
    }
    for (size_t i = 0; i < world.robots.size(); ++i) {
      const auto& robot = measured.at("robots").at(i);
      const PlacedRobot& placed = world.robots[i];
      REQUIRE(robot.at("dof").size() == placed.dofs.size());
      for (size_t d = 0; d < placed.dofs.size(); ++d) {
        const auto& dof = robot.at("dof").at(d);
        const DofSpec& spec = placed.robot.dofs[d];
        const auto [low, high] = dof_range(placed.robot, static_cast<int>(d));
        CHECK(placed.dofs[d] == doctest::Approx(dof.at("value").get<double>()));
        CHECK(low == doctest::Approx(dof.at("min").get<double>()));
        CHECK(high == doctest::Approx(dof.at("max").get<double>()));
        CHECK(spec.default_velocity == doctest::Approx(dof.at("default_velocity").get<double>()));
        CHECK(spec.max_effort * 1e9 == doctest::Approx(dof.at("max_force").get<double>()));
        CHECK(static_cast<int>(spec.kind) == dof.at("type").get<int>());
      }
      if (!placed.robot.X_BA) continue;
      const auto& q = robot.at("approach_tran").at("q_wxyz");
      CHECK(placed.robot.X_BA->rotation.angularDistance(
                Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3))) < 1e-7);
      CHECK(
          (placed.robot.X_BA->position * 1000 - vector(robot.at("approach_tran").at("t"))).norm() <
          1e-9);
    }
  }
}
