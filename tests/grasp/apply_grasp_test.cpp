// Applying a stored grasp to a world.
#include <doctest/doctest.h>

#include <array>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/grasp/wrench/grasp.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/motion/drive.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

namespace {

// a hand with couplings of each kind, closed
struct Closed {
  World world;
  Id<Robot> hand;
  Id<Body> object;
  Grasp grasp;
};

Closed closed(const char* file) {
  Closed c{build_world(read_world(file, {.root = "."})), {}, {}, {}};
  c.hand = c.world.robots().front();
  for (const auto body : c.world.bodies())
    if (c.world.body(body).kind == BodyKind::object) c.object = body;
  autograsp(c.world, c.hand);
  c.grasp = find_grasp(c.world, c.hand, c.object);
  return c;
}

}  // namespace

TEST_CASE("a grasp applied to the displaced object equals the evaluated grasp") {
  Random random(5);
  for (const char* file : {"worlds/barrett_mug.wld", "worlds/dlr_flask.wld"}) {
    Closed c = closed(file);
    REQUIRE(c.grasp.contacts.size() > 1);
    REQUIRE(c.grasp.links.size() == c.grasp.points.size());
    for (int turn = 0; turn < 5; ++turn) {
      World other = c.world;
      other.set_dofs(
          c.hand,
          Eigen::VectorXd::Zero(other.dofs(c.hand).size()).cwiseMax(other.dofs(c.hand) * 0.1));
      other.set_pose(c.object, random_pose(random, 0.4));
      apply_grasp(other, c.grasp);
      const Pose X_OH = other.pose(c.object).inverse() * other.pose(other.robot(c.hand).base);
      // rounding of two products of poses within a meter
      CHECK((X_OH.position - c.grasp.X_OH->position).norm() < 1e-14);
      CHECK((X_OH.inverse() * *c.grasp.X_OH).angle() < 1e-7);
      CHECK(std::ranges::equal(other.dofs(c.hand), c.grasp.dofs));
      CHECK(std::ranges::equal(other.joints(c.hand), c.grasp.joints));
      check_unmoved(other, c.grasp);
    }
  }
}

TEST_CASE("a grasp that does not fit a world is rejected and moves nothing") {
  Closed c = closed("worlds/barrett_mug.wld");
  const auto refuse = [&](const GraspSpec& grasp, const char* message) {
    World world = c.world;
    const uint64_t before = world.hash();
    CHECK_THROWS_WITH_AS(apply_grasp(world, grasp), doctest::Contains(message), Error);
    CHECK(world.hash() == before);
  };
  GraspSpec grasp = c.grasp;
  grasp.hand_name = "nobody";
  refuse(grasp, "there is no such hand in this world");
  grasp = c.grasp;
  grasp.object_name = "nothing";
  refuse(grasp, "there is no such object in this world");
  grasp = c.grasp;
  grasp.dofs.pop_back();
  refuse(grasp, "it has 3 DOFs and 8 joints, the hand 4 and 8");
  grasp = c.grasp;
  grasp.X_OH.reset();
  refuse(grasp, "it contains no pose of the hand");
  grasp = c.grasp;
  grasp.dofs[1] = 100;
  refuse(grasp, "must lie in");
}

TEST_CASE("a grasp caches its wrench spaces, and a copy starts with an empty cache") {
  const Closed c = closed("worlds/dlr_flask.wld");
  const WrenchSpacePtr first = space_of(c.grasp);
  CHECK(space_of(c.grasp) == first);
  const WrenchSpacePtr linf = space_of(c.grasp, {.space = {.norm = WrenchNorm::linf}});
  CHECK(linf != first);
  CHECK(space_of(c.grasp) == first);
  for (int edges = 3; edges < 18; ++edges) space_of(c.grasp, {.edges = edges});
  CHECK(space_of(c.grasp, {.space = {.norm = WrenchNorm::linf}}) != linf);
  const Grasp copy = c.grasp;
  CHECK(space_of(copy) != space_of(c.grasp));
  CHECK(space_of(copy)->epsilon() == first->epsilon());
}
