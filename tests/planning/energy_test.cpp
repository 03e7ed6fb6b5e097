#include "clench/planning/energy/energy.h"

#include <nlohmann/json.hpp>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/grasp/wrench/grasp.h"
#include "clench/model/find.h"
#include "clench/motion/drive.h"
#include "clench/motion/virtual_contacts.h"
#include "clench/planning/energy/closing_energy.h"
#include "clench/planning/energy/constraint_energy.h"
#include "planning/scene.h"
#include "support/measured.h"
#include "support/robots.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

// a term that counts its evaluations
struct Constant : Energy {
  double x, low;
  int* asked;
  Constant(double value, double least, int* count) : x(value), low(least), asked(count) {}
  double bounded_value(World&, double) override { return ++*asked, x; }
  double lower_bound() const override { return low; }
  EnergyPtr clone() const override { return std::make_unique<Constant>(*this); }
};

EnergySum sum_of(std::vector<std::pair<double, double>> terms, int* asked) {
  std::vector<EnergySum::Term> out;
  for (const auto& [weight, value] : terms)
    out.push_back({weight, std::make_unique<Constant>(value, 0, asked)});
  return EnergySum(std::move(out));
}

// the hand in a random pose near the object, without collision
void place_at_random(HandScene& scene, Random& random) {
  const SearchSpace space(scene.robot(), scene.state(), {.posture = PostureKind::dofs});
  do {
    Values v(space.variables().size());
    for (int i = 0; i < v.size(); ++i)
      v[i] = random.uniform(space.variables()[i].min, space.variables()[i].max);
    const HandState state = space.state(v);
    scene.world.set_posture(scene.hand, state.X_RH, state.dofs);
  } while (collides(scene.world));
}

}  // namespace

TEST_CASE("a sum stops when its remaining terms cannot bring it below the bound") {
  World world;
  int asked = 0;
  EnergySum sum = sum_of({{1, 2}, {0.5, 4}, {2, 3}}, &asked);
  CHECK(sum.value(world, 100) == doctest::Approx(10));
  CHECK(asked == 3);
  asked = 0;
  CHECK(sum.value(world, 1) > 1);
  CHECK(asked == 1);
  CHECK(sum.lower_bound() == 0);
  CHECK_THROWS_WITH_AS(sum_of({{-1, 2}}, &asked), "energy: a weight must be >= 0, got -1", Error);
}

TEST_CASE("a term is clamped to its bounds") {
  World world;
  int asked = 0;
  const auto within = [&](double low, double high) {
    return EnergyWithin(std::make_unique<Constant>(5, 0, &asked), low, high).value(world, infinite);
  };
  CHECK(within(-infinite, infinite) == 5);
  CHECK(within(6, 7) == 6);
  CHECK(within(1, 3) == 3);
  CHECK_THROWS_WITH_AS(within(2, 1), "energy: expected low <= high, got 2 and 1", Error);
}

TEST_CASE("a function that returns no number is rejected") {
  World world;
  EnergyFunction nothing([] { return std::nan(""); });
  CHECK_THROWS_WITH_AS(nothing.value(world, 0), "energy: expected a number, got nan", Error);
}

TEST_CASE("contact energy is the mean over all sites, compared with a search of all triangles") {
  HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  const HandAndObject who{scene.hand, scene.object};
  ContactEnergy energy(scene.world, who, {});
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    place_at_random(scene, random);
    double sum = 0;
    const auto sites = virtual_contacts(scene.world, scene.hand);
    for (const auto& site : sites) {
      const Pose X = scene.world.pose(scene.robot().body_of(site.link)) * site.X_LC;
      // without a seed
      const auto near = closest_point(*scene.world.body(scene.object).shape, X.position);
      const Vector3d way = near.point - X.position;
      sum += 1000 * way.norm() + 50 * (1 - (X.rotation * Vector3d::UnitZ()).dot(way.normalized()));
    }
    const double expected = sum / static_cast<double>(sites.size());
    // twenty sums of numbers of a few hundred
    CHECK(energy.value(scene.world) == doctest::Approx(expected).epsilon(1e-12));
    // a bound changes no value at or below it
    CHECK(energy.value(scene.world, expected * (1 + 1e-9)) == energy.value(scene.world));
    CHECK(energy.value(scene.world, expected / 2) > expected / 2);
  }
}

TEST_CASE(
    "energies are invariant under motions of the world and do not depend on earlier evaluations") {
  HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  const HandAndObject who{scene.hand, scene.object};
  Random random(4);
  const Pose turn{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.3, -0.2, 0.1}};
  ContactEnergy used(scene.world, who, {});
  PotentialQuality potential(scene.world, who, {});
  for (int i = 0; i < 10; ++i) {
    place_at_random(scene, random);
    const double here = used.value(scene.world), hold = potential.value(scene.world);
    ContactEnergy fresh(scene.world, who, {});
    CHECK(fresh.value(scene.world) == here);
    World moved = scene.world;
    moved.set_pose(scene.object, turn);
    moved.set_pose(scene.hand, turn * scene.world.pose(scene.robot().base));
    CHECK(used.value(moved) == doctest::Approx(here).epsilon(1e-9));
    CHECK(potential.value(moved) == doctest::Approx(hold).epsilon(1e-9));
  }
}

TEST_CASE(
    "a closing energy is minus the measures of the closed grasp, and leaves the world unchanged") {
  HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  const HandAndObject who{scene.hand, scene.object};
  Random random(5);
  ClosingEnergy energy(who, {});
  for (int i = 0; i < 10; ++i) {
    place_at_random(scene, random);
    const uint64_t before = scene.world.hash();
    const double got = energy.value(scene.world);
    CHECK(scene.world.hash() == before);
    World closed = scene.world;
    autograsp(closed, scene.hand);
    const Grasp grasp = find_grasp(closed, scene.hand, scene.object);
    const double worth = grasp.contacts.empty()
                             ? 0
                             : 100 * space_of(grasp)->epsilon() + 30 * space_of(grasp)->volume();
    CHECK(got == (worth == 0 ? 0 : -worth));
  }
  CHECK_THROWS_WITH_AS(ClosingEnergy(who, {.volume_weight = -1}),
                       "energy: volume_weight must be >= 0, got -1", Error);
  CHECK_THROWS_WITH_AS(ClosingEnergy(who, {.approach = infinite}),
                       "energy: approach must be >= 0, got inf", Error);
}

TEST_CASE("constraints are 0 if they are satisfied and grow with their violation") {
  HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  scene.world.set_pose(scene.hand, Pose::translation({0, 0, 0.5}));
  const Vector3d z =
      (scene.world.pose(scene.robot().base) * scene.robot().X_BA).rotation * Vector3d::UnitZ();
  CHECK(approach_cone_energy(scene.hand, z, 0.1)->value(scene.world) == 0);
  CHECK(approach_cone_energy(scene.hand, -z, 0.1)->value(scene.world) ==
        doctest::Approx(std::numbers::pi - 0.1));
  CHECK(reach_energy(scene.hand, {0, 0, 0.5}, 10)->value(scene.world) == 0);
  const Vector3d at = (scene.world.pose(scene.robot().base) * scene.robot().X_BA).position;
  CHECK(reach_energy(scene.hand, at + Vector3d(0, 0.3, 0), 0.1)->value(scene.world) ==
        doctest::Approx(200));
  CHECK(keep_out_energy(scene.hand, {}, {5, 5, 5}, {6, 6, 6})->value(scene.world) == 0);
  // a half space that contains the complete hand
  CHECK(keep_out_energy(scene.hand, {}, {-5, -5, -5}, {5, 5, 0.6})->value(scene.world) > 100);
  CHECK(penetration_energy(scene.world, scene.hand)->value(scene.world) == 0);
  CHECK_THROWS_WITH_AS(approach_cone_energy(scene.hand, {0, 0, 0}, 0.1),
                       "energy: axis: expected a direction", Error);
  CHECK_THROWS_WITH_AS(approach_cone_energy(scene.hand, z, 4),
                       "energy: angle must lie in [0, pi] rad, got 4", Error);
  CHECK_THROWS_WITH_AS(reach_energy(scene.hand, z, -1), "energy: radius must be >= 0 [m], got -1",
                       Error);
  CHECK_THROWS_AS(keep_out_energy(scene.hand, {}, {1, 0, 0}, {0, 1, 1}), Error);
  CHECK_THROWS_WITH_AS(penetration_energy(scene.world, scene.hand, 0),
                       "energy: points: expected 1 to 10000, got 0", Error);
}

TEST_CASE("clearance and penetration agree with closed formulas on boxes") {
  World world;
  HandScene scene = hand_scene("parallel_jaw/parallel_jaw.cfg", "cube.iv");
  const auto floor = scene.world.add_body(read_body("models/obstacles/floor.iv", {}),
                                          BodyKind::obstacle, Pose::translation({0, 0, -1}));
  const HandAndObject who{scene.hand, scene.object};
  scene.world.set_pose(scene.hand, Pose::translation({0, 0, 0.6}));
  const auto parts = scene.world.bodies_of(scene.hand);
  const double gap = distance(scene.world, parts, std::array{floor}).distance;
  REQUIRE(gap > 0.1);
  CHECK(clearance_energy(who, gap - 0.01)->value(scene.world) == 0);
  CHECK(clearance_energy(who, gap + 0.01)->value(scene.world) == doctest::Approx(10));
  CHECK_THROWS_WITH_AS(clearance_energy(who, -1), "energy: distance must be >= 0 [m], got -1",
                       Error);
  // 5 mm inside the top of the floor
  const EnergyPtr penetration = penetration_energy(scene.world, scene.hand, 2000);
  const Pose X = scene.world.pose(scene.robot().base);
  scene.world.set_pose(scene.object, Pose::translation({3, 0, 0}));
  scene.world.set_pose(scene.hand, Pose{X.rotation, X.position - Vector3d(0, 0, gap + 0.005)});
  CHECK(penetration->value(scene.world) > 4.9);
  // a rod through the palm: neither contains a corner of the other
  scene.world.set_pose(scene.hand, X);
  const Body& palm = scene.world.body(scene.robot().base);
  const Bounds box = palm.shape->bounds();
  const auto rod =
      scene.world.add_body(test::body_spec("rod", test::box(0.002, 0.002, 1)), BodyKind::obstacle,
                           scene.world.pose(scene.robot().base) * Pose::translation(box.center()));
  REQUIRE(collides(scene.world, std::array{rod}));
  CHECK(penetration->value(scene.world) > 0.9);
}

TEST_CASE("energies of 600 states of Barrett and mug equal the original's") {
  REQUIRE_SHARED();
  const auto data = measured("energy_barrett_mug");
  const auto models = shared() / "data/graspit-xml/models";
  World world;
  const auto hand = add_robot(world, read_robot(models / "robots/Barrett/Barrett.xml", {}), {});
  const auto mug = world.add_body(read_body(models / "objects/mug.xml", {}), BodyKind::object, {});
  ContactEnergy contact(world, {hand, mug}, {});
  GuidedClosingEnergy guided(world, {hand, mug}, {.facing = Facing::away});
  int legal = 0, closed = 0;
  for (const auto& state : data["states"]) {
    const auto &t = state["hand_tran"]["t"], &q = state["hand_tran"]["q_wxyz"];
    const std::vector<double> dofs = state["dof"];
    world.set_posture(hand,
                      {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized(),
                       1e-3 * Vector3d(t[0], t[1], t[2])},
                      Eigen::Map<const Eigen::VectorXd>(dofs.data(), std::ssize(dofs)));
    CHECK(collides(world) != state["legal"].get<bool>());
    if (!state["legal"].get<bool>()) continue;
    ++legal;
    // the original keeps six digits of a vertex
    CHECK(contact.value(world) ==
          doctest::Approx(state["energy"]["CONTACT_ENERGY"].get<double>()).epsilon(1e-5));
    if (!state["energy"].contains("GUIDED_AUTO_GRASP_QUALITY_ENERGY")) continue;
    ++closed;
    CHECK(guided.value(world) ==
          doctest::Approx(state["energy"]["GUIDED_AUTO_GRASP_QUALITY_ENERGY"].get<double>())
              .epsilon(1e-5));
  }
  CHECK(legal == 382);
  CHECK(closed == 30);
}

TEST_CASE("an energy without anything to evaluate is rejected") {
  HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  CHECK_THROWS_WITH_AS(ContactEnergy(scene.world, {scene.hand, scene.robot().base}, {}),
                       "energy of 'barrett' and 'barrett_base': the object is a part of a robot",
                       Error);
  scene.world.set_virtual_contacts(scene.hand, std::make_shared<std::vector<VirtualContactSpec>>());
  CHECK_THROWS_WITH_AS(ContactEnergy(scene.world, {scene.hand, scene.object}, {}),
                       "energy of 'barrett' and 'mug': the hand has no virtual contacts", Error);
  CHECK_THROWS_WITH_AS(
      ContactEnergy(scene.world, {scene.hand, scene.object}, {.normal_weight = -1}),
      "energy of 'barrett' and 'mug': the hand has no virtual contacts", Error);
}
