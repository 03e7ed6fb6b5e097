// XML models of the last GraspIt! generation, if installed, compared with its text models.
#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "clench/io/text/xml.h"
#include "support/shared.h"

using namespace clench;
namespace fs = std::filesystem;

static fs::path text_root() { return test::shared() / "data/graspit"; }
static fs::path xml_root() { return test::shared() / "data/graspit-xml"; }

/// Files whose root element has this name.
static std::vector<fs::path> files_of(const std::string& root_name) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(xml_root())) {
    if (entry.path().extension() != ".xml") continue;
    const std::string text = read_text(entry.path());
    if (xml_root_name(text) == root_name) out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST_CASE("every XML body of the original loads, with triangles unless it names none") {
  REQUIRE_SHARED();
  const auto files = files_of("root");
  CHECK(files.size() == 138);
  int frames = 0;
  for (const auto& file : files) {
    INFO(file.string());
    BodySpec body;
    CHECK_NOTHROW(body = read_body(file));
    frames += !body.shape;
  }
  CHECK(frames == 2);  // the template of all bodies, and a link that is a frame
}

TEST_CASE("every XML robot of the original loads, and every XML world") {
  REQUIRE_SHARED();
  const auto robots = files_of("robot"), worlds = files_of("world");
  CHECK(robots.size() == 26);
  CHECK(worlds.size() == 4);
  for (const auto& file : robots) {
    INFO(file.string());
    RobotSpec robot;
    CHECK_NOTHROW(robot = read_robot(file));
    CHECK(robot.base.shape);
    CHECK_FALSE(robot.dofs.empty());
  }
  ReadOptions options;
  options.root = xml_root();
  for (const auto& file : worlds) {
    INFO(file.string());
    WorldSpec world;
    CHECK_NOTHROW(world = read_world(file, options));
    CHECK(world.camera);
  }
}

TEST_CASE("hands that exist in both generations are the same in both") {
  REQUIRE_SHARED();
  for (const std::string hand :
       {"Barrett/Barrett", "HumanHand/HumanHand20DOF", "HumanHand/HumanHand16DOF"}) {
    INFO(hand);
    const RobotSpec text = read_robot(text_root() / "models/robots" / (hand + ".cfg"));
    const RobotSpec xml = read_robot(xml_root() / "models/robots" / (hand + ".xml"));
    REQUIRE(text.dofs.size() == xml.dofs.size());
    for (size_t i = 0; i < text.dofs.size(); ++i) {
      CHECK(text.dofs[i].kind == xml.dofs[i].kind);
      CHECK(text.dofs[i].max_effort == xml.dofs[i].max_effort);
      CHECK(text.dofs[i].breakaway_torque == xml.dofs[i].breakaway_torque);
    }
    REQUIRE(text.links.size() == xml.links.size());
    for (size_t l = 0; l < text.links.size(); ++l) {
      const LinkSpec &a = text.links[l], &b = xml.links[l];
      CHECK(a.parent == b.parent);
      REQUIRE(a.joints.size() == b.joints.size());
      for (size_t j = 0; j < a.joints.size(); ++j) {
        const JointSpec &p = a.joints[j], &q = b.joints[j];
        CHECK(std::tie(p.kind, p.dof, p.ratio, p.min, p.max) ==
              std::tie(q.kind, q.dof, q.ratio, q.min, q.max));
        // one file gives the start of a finger by a rotation, the other by a matrix
        if (a.parent < 0 && j == 0)
          CHECK((p.X_PJ.position - q.X_PJ.position).norm() < 1e-12);
        else
          CHECK(p.X_PJ == q.X_PJ);
        CHECK(p.axis == q.axis);
      }
      CHECK(a.X_JL == b.X_JL);
    }
  }
}
