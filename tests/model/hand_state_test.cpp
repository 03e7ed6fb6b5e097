// Eigengrasps and virtual contacts as part of a robot: rejected if they do not fit; in clones,
// snapshots and hashes.
#include "clench/base/error.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

std::shared_ptr<const EigengraspSet> one_grasp(double second) {
  EigengraspSet set;
  set.dofs = 2;
  set.grasps.push_back({Eigen::Vector2d(1, second), 0.5, std::nullopt});
  return std::make_shared<EigengraspSet>(set);
}

std::shared_ptr<const std::vector<VirtualContactSpec>> one_contact(double x) {
  VirtualContactSpec contact{.link = 2, .X_LC = Pose::translation({x, 0, 0}), .edges = {}};
  return std::make_shared<std::vector<VirtualContactSpec>>(1, contact);
}

}  // namespace

TEST_CASE("sets that do not fit the robot are rejected with its name") {
  World world;
  const auto hand = world.add_robot(two_finger(), {});
  EigengraspSet set = identity_eigengrasps(3);
  CHECK_THROWS_WITH_AS(world.set_eigengrasps(hand, std::make_shared<EigengraspSet>(set)),
                       "eigengrasps of robot 'gripper': expected a set for 2 DOFs, got one for 3",
                       Error);
  set = identity_eigengrasps(2);
  set.grasps[1].vector[1] = 0;
  CHECK_THROWS_WITH_AS(world.set_eigengrasps(hand, std::make_shared<EigengraspSet>(set)),
                       "eigengrasps of robot 'gripper': eigengrasp 2: expected a vector other than "
                       "zero, got one of length 0",
                       Error);

  const auto place = [&](int link, double mu = 1) {
    VirtualContactSpec contact{.link = link, .X_LC = {}, .mu = mu, .edges = {}};
    world.set_virtual_contacts(hand, std::make_shared<std::vector<VirtualContactSpec>>(1, contact));
  };
  CHECK_NOTHROW(place(-1));
  CHECK_THROWS_WITH_AS(
      place(4),
      "virtual contact 1 of robot 'gripper': expected a link from -1, the base, to 3, got 4",
      Error);
  CHECK_THROWS_AS(place(-2), Error);
  CHECK_THROWS_WITH_AS(
      place(0, -1),
      "virtual contact 1 of robot 'gripper': mu: expected a number from 0 to 1e+06, got -1", Error);
}

TEST_CASE("a robot with an inconsistent description is not added") {
  World world;
  RobotSpec spec = two_finger();
  spec.eigengrasps = identity_eigengrasps(5);
  CHECK_THROWS_WITH_AS(world.add_robot(spec, {}),
                       "eigengrasps of 5 DOFs do not fit 'gripper', which has 2", Error);
  CHECK(world.robots().empty());
  CHECK(world.bodies().empty());
}

TEST_CASE("clones and snapshots keep their values, and are not affected by later changes") {
  World world;
  const auto hand = world.add_robot(two_finger(), {});
  world.set_eigengrasps(hand, one_grasp(1));
  world.set_virtual_contacts(hand, one_contact(0.01));
  const World clone = world;
  const auto before = world.snapshot();
  const uint64_t hash = world.hash();
  CHECK(clone.hash() == hash);

  world.set_eigengrasps(hand, one_grasp(2));
  CHECK(world.hash() != hash);
  CHECK(clone.robot(hand).eigengrasps->grasps[0].vector[1] == 1);
  world.restore(*before);
  CHECK(world.hash() == hash);

  world.set_virtual_contacts(hand, one_contact(0.02));
  CHECK(world.hash() != hash);
  CHECK((*clone.robot(hand).virtual_contacts)[0].X_LC.position.x() == 0.01);
  world.restore(*before);
  world.set_virtual_contacts(hand, nullptr);
  CHECK(world.hash() != hash);
  world.restore(*before);
  world.set_eigengrasps(hand, nullptr);
  CHECK(world.hash() != hash);
}
