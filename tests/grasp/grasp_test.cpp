#include "clench/grasp/wrench/grasp.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "clench/base/error.h"
#include "support/shapes.h"

using namespace clench;
using Eigen::Vector3d;

namespace {

constexpr double thin = 5e-5;  // within the contact threshold [m]

BodySpec body(const std::string& name, const Mesh& mesh, const std::string& material) {
  BodySpec spec;
  spec.name = name;
  spec.shape = Shape::make(mesh, name);
  spec.material = material;
  return spec;
}

// a finger that slides along z of its initial frame, 0.1 m beside the middle
void add_finger(RobotSpec& robot, const std::string& name, const Pose& X_BC, int dof) {
  LinkSpec link{.body = body(name, test::box(0.02, 0.02, 0.02), "rubber")};
  link.joints = {{.kind = JointKind::prismatic, .X_PJ = X_BC, .dof = dof, .min = 0, .max = 0.1}};
  robot.links.push_back(link);
}

// a gripper: palm below, a finger on each side
RobotSpec gripper() {
  const double quarter = std::numbers::pi / 2;
  RobotSpec spec;
  spec.name = "gripper";
  spec.base = body("palm", test::box(0.2, 0.02, 0.02), "rubber");
  spec.dofs.resize(2);
  const auto turned = [](double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  };
  add_finger(spec, "left", {turned(quarter), {-0.1, 0, 0.1}}, 0);
  add_finger(spec, "right", {turned(-quarter), {0.1, 0, 0.1}}, 1);
  return spec;
}

struct Scene {
  World world;
  Id<Robot> hand;
  Id<Body> object;
};

// a cube of 0.1 m between both fingers; `X` moves the complete scene
Scene scene(const Pose& X = Pose()) {
  Scene s;
  s.hand = s.world.add_robot(gripper(), X);
  s.object = s.world.add_body(body("cube", test::box(0.1, 0.1, 0.1), "wood"), BodyKind::object,
                              X * Pose::translation({0, 0, 0.1}));
  return s;
}

void close(Scene& s) { s.world.set_dofs(s.hand, Eigen::Vector2d::Constant(0.1 - 0.06 - thin)); }

}  // namespace

TEST_CASE("a hand without contacts has an empty grasp, which is not an error") {
  Scene s = scene();
  const Grasp grasp = find_grasp(s.world, s.hand, s.object);
  CHECK(grasp.contacts.empty());
  const WrenchSpace space = wrench_space(grasp);
  CHECK(space.rank() == 0);
  CHECK(space.epsilon() == 0);
}

TEST_CASE("contacts lie on the object and push into it, in its own frame") {
  Scene s = scene();
  close(s);
  const Grasp grasp = find_grasp(s.world, s.hand, s.object);
  REQUIRE(grasp.contacts.size() == 8);  // four corners per finger
  REQUIRE(grasp.points.size() == 8);
  for (size_t i = 0; i < 8; ++i) {
    const PointContact& p = grasp.points[i];
    CHECK(grasp.contacts[i].body == s.object);
    CHECK(std::abs(std::abs(p.p_O.x()) - 0.05) < 1e-12);
    CHECK(std::abs(p.p_O.y()) == doctest::Approx(0.01));
    CHECK(std::abs(p.p_O.z()) == doctest::Approx(0.01));
    CHECK((p.n_O - Vector3d(p.p_O.x() < 0 ? 1 : -1, 0, 0)).norm() < 1e-9);
    CHECK(p.mu == 1.0);  // rubber on wood
  }
  CHECK(grasp.com.norm() < 1e-12);
  CHECK(grasp.rho == doctest::Approx(0.05 * std::sqrt(3.0)));
}

TEST_CASE("two faces with friction are a force closure, and without friction they are not") {
  Scene s = scene();
  close(s);
  const WrenchSpace held = wrench_space(find_grasp(s.world, s.hand, s.object));
  CHECK(held.is_force_closure());
  CHECK(held.rank() == 6);
  s.world.set_friction("rubber", "wood", {.statics = 0, .kinetic = 0});
  const WrenchSpace slips = wrench_space(find_grasp(s.world, s.hand, s.object));
  // along the line of the fingers, and two rotations across it
  CHECK(slips.rank() == 3);
  CHECK(slips.epsilon() == 0);
}

TEST_CASE("contacts of another hand or the floor with the object are not part of this grasp") {
  Scene s = scene();
  close(s);
  const double before = wrench_space(find_grasp(s.world, s.hand, s.object)).epsilon();
  s.world.add_body(body("block", test::box(0.1, 0.1, 0.1), "wood"), BodyKind::obstacle,
                   Pose::translation({0, 0, 0.2 + thin}));
  CHECK(wrench_space(find_grasp(s.world, s.hand, s.object)).epsilon() == before);
}

TEST_CASE("quality does not depend on the position of the grasp") {
  Scene s = scene();
  close(s);
  const WrenchSpace here = wrench_space(find_grasp(s.world, s.hand, s.object));
  const Pose X{Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {0.3, -0.2, 0.5}};
  Scene t = scene(X);
  close(t);
  const WrenchSpace there = wrench_space(find_grasp(t.world, t.hand, t.object));
  // contact points move by rounding over the gap's slope: 1e-15 / 1e-4 in the normals
  CHECK(std::abs(here.epsilon() - there.epsilon()) < 1e-9);
  CHECK(std::abs(here.volume() - there.volume()) < 1e-9);
}

TEST_CASE("a longer torque length reduces the weight of torques") {
  Scene s = scene();
  close(s);
  const auto epsilon = [&](double rho) {
    return wrench_space(find_grasp(s.world, s.hand, s.object, {.rho = rho})).epsilon();
  };
  CHECK(epsilon(0.1) > epsilon(0.2));
  CHECK(epsilon(0.2) > epsilon(0.4));
}

TEST_CASE("the torque length is the maximal radius, or that of gyration, or a given number") {
  Scene s = scene();
  close(s);
  const Grasp grasp = find_grasp(s.world, s.hand, s.object);
  const Grasp by_mass =
      find_grasp(s.world, s.hand, s.object, {.length = TorqueLength::gyration_radius});
  // for a cube of side a: a sqrt(3) / 2, and a / 2, because its inertia is m a^2 / 6 about each
  // axis
  CHECK(grasp.rho == doctest::Approx(0.05 * std::sqrt(3.0)));
  CHECK(by_mass.rho == doctest::Approx(0.05));
  CHECK(std::abs(wrench_space(grasp, {.rho = by_mass.rho}).epsilon() -
                 wrench_space(by_mass).epsilon()) < 1e-12);
  const WrenchSpace round = wrench_space(grasp, {.edges = round_edges});
  CHECK(round.is_round());
  CHECK(round.epsilon() >= wrench_space(grasp).epsilon());
  CHECK(wrench_space(grasp, {.space = {.coordinates = {0, 1, 2}}}).dimension() == 3);
}

TEST_CASE("an invalid grasp is rejected by name") {
  Scene s = scene();
  const auto refuse = [&](Id<Body> object, const GraspOptions& options, const char* message) {
    CHECK_THROWS_WITH_AS(find_grasp(s.world, s.hand, object, options), message, Error);
  };
  refuse(s.object, {.edges = 2, .rho = {}},
         "grasp of cube by gripper: edges must be 3 to 1000, got 2");
  refuse(s.object, {.rho = 0.0}, "grasp of cube by gripper: rho must be > 0 [m], got 0");
  refuse(s.object, {.rho = std::numeric_limits<double>::quiet_NaN()},
         "grasp of cube by gripper: rho must be > 0 [m], got nan");
  const Id<Body> palm = s.world.robot(s.hand).base;
  const std::string name = s.world.body(palm).name;
  CHECK_THROWS_WITH_AS(
      find_grasp(s.world, s.hand, palm),
      ("grasp of " + name + " by gripper: " + name + " is a part of gripper").c_str(), Error);
  const Id<Body> gone = s.object;
  s.world.remove(gone);
  CHECK_THROWS_AS(find_grasp(s.world, s.hand, gone), Error);
}

TEST_CASE("soft contacts resist torsion as their patches do, and hard ones do not") {
  Scene s = scene();
  close(s);
  for (const PointContact& p : find_grasp(s.world, s.hand, s.object).points)
    CHECK(p.torsion_radius == 0);
  s.world.set_elastic_modulus(s.object, 1.5e6);
  const Grasp soft = find_grasp(s.world, s.hand, s.object);
  REQUIRE(soft.points.size() == 8);
  CHECK(soft.contacts_at_edges == 0);
  for (size_t i = 0; i < soft.points.size(); ++i) {
    CHECK(soft.contacts[i].kind == ContactKind::soft);
    CHECK(soft.points[i].torsion_radius == torsion_radius(soft_patch(*soft.contacts[i].site), 5));
    CHECK(soft.points[i].torsion_radius > 0);
  }
  // the radius grows with the fourth root of force and compliance
  const auto radius = [&](const GraspOptions& options) {
    return find_grasp(s.world, s.hand, s.object, options).points[0].torsion_radius;
  };
  CHECK(radius({.normal_force = 80}) == doctest::Approx(2 * radius({})).epsilon(0.01));
  CHECK(radius({.soft = false}) == 0);
  // one force per contact; a contact without force has no torsion radius
  std::vector<double> forces(soft.points.size());
  for (size_t i = 0; i < forces.size(); ++i) forces[i] = static_cast<double>(i);
  const Grasp own = find_grasp(s.world, s.hand, s.object, {.normal_force = forces});
  for (size_t i = 0; i < forces.size(); ++i)
    CHECK(own.points[i].torsion_radius ==
          torsion_radius(soft_patch(*own.contacts[i].site), forces[i]));
  CHECK(own.points[0].torsion_radius == 0);
  s.world.set_soft_layer(s.object, 0.003 / 16);
  CHECK(2 * radius({}) == doctest::Approx(soft.points[0].torsion_radius));
  for (const Id<Body> id : s.world.bodies_of(s.hand)) s.world.set_elastic_modulus(id, 1e6);
  CHECK(radius({}) > radius({.modulus = ModulusRule::larger}));
  s.world.set_friction("rubber", "wood", {.statics = 0, .kinetic = 0});
  CHECK(radius({}) == 0);
  CHECK_THROWS_WITH_AS(find_grasp(s.world, s.hand, s.object, {.normal_force = 0}),
                       "grasp of cube by gripper: the normal force must be > 0 [N], got 0", Error);
  CHECK_THROWS_WITH_AS(find_grasp(s.world, s.hand, s.object, {.normal_force = {{5, -1}}}),
                       "grasp of cube by gripper: the normal force must be > 0 [N], got -1", Error);
  const std::string count = std::to_string(find_grasp(s.world, s.hand, s.object).contacts.size());
  const std::string expected = "grasp of cube by gripper: normal_force: expected one number or " +
                               count + ", one per contact, got 2";
  CHECK_THROWS_WITH_AS(find_grasp(s.world, s.hand, s.object, {.normal_force = {{5, 1}}}),
                       expected.c_str(), Error);
}
