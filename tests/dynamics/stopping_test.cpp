// Stopped steps: response times, and the state afterwards.
#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/dynamics/stepper.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

// boxes side by side on a table, so close that neighbors touch
World crowd(int side, DynamicsEngine engine = DynamicsEngine::clench,
            FrictionCone cone = FrictionCone::round) {
  World world;
  world.add_body(body_spec("table", box(2, 2, 0.1)), BodyKind::obstacle,
                 Pose::translation({0, 0, -0.05}));
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      world.add_body(body_spec("box", box(0.1, 0.1, 0.1)), BodyKind::object,
                     Pose::translation({0.10005 * i, 0.10005 * j, 0.05005}));
  DynamicSettings settings = world.dynamic_settings();
  settings.engine = engine;
  settings.cone = cone;
  world.set_dynamic_settings(settings);
  return world;
}

// all data that a step changes, bit-exactly
struct Moment {
  uint64_t hash;
  double time;
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3d> velocities, forces;
  int64_t steps, iterations;

  explicit Moment(const World& world) : hash(world.hash()), time(world.time()) {
    for (const auto id : world.bodies()) {
      poses.push_back(world.pose(id));
      velocities.push_back(world.twist(id).linear);
      velocities.push_back(world.twist(id).angular);
    }
    const DynamicState* state = world.dynamics();
    steps = state ? state->report.steps : 0;
    iterations = state ? state->report.iterations : 0;
    for (const Manifold& m : state ? state->manifolds : std::vector<Manifold>())
      for (const ManifoldPoint& p : m.points) forces.push_back(p.force);
  }
  bool operator==(const Moment&) const = default;
};

constexpr double dt = 0.001;  // one step

uint64_t checks_of_step(World& world) {
  const Watched watched{Progress()};
  Stepper(world).run(dt);
  return watched.checks();
}

}  // namespace

TEST_CASE("a stopped step leaves the world unchanged, and the next step is unaffected") {
  for (const FrictionCone cone : {FrictionCone::round, FrictionCone::pyramid}) {
    World world = crowd(2, DynamicsEngine::clench, cone), other = world;
    Stepper(world).run(2 * dt);
    const Moment before(world);
    World counted = world;
    const uint64_t checks = checks_of_step(counted);
    REQUIRE(checks > 20);
    // early, in the middle, and before the end
    for (const uint64_t at : {uint64_t{1}, checks / 3, checks / 2, checks - 1}) {
      CAPTURE(at);
      Stepper stepper(world);
      Watched watched{Progress()};
      watched.stop_at(at);
      CHECK_THROWS_AS(stepper.run(dt), Stopped);
      CHECK(Moment(world) == before);
    }
    Stepper(world).run(dt);
    Stepper(other).run(3 * dt);
    CHECK(Moment(world) == Moment(other));
  }
}

TEST_CASE("the halves of a step stop like a step") {
  World world = crowd(2);
  Stepper stepper(world);
  stepper.run(dt);
  const Moment before(world);
  for (const bool moves : {true, false}) {
    Watched watched{Progress()};
    watched.stop_at(3);
    if (moves)
      CHECK_THROWS_AS(stepper.move(dt), Stopped);
    else
      CHECK_THROWS_AS(stepper.solve(dt), Stopped);
    CHECK(Moment(world) == before);
  }
}

TEST_CASE("steps with more work check for stops more often") {
  for (const FrictionCone cone : {FrictionCone::round, FrictionCone::pyramid}) {
    World few = crowd(2, DynamicsEngine::clench, cone),
          many = crowd(3, DynamicsEngine::clench, cone);
    const uint64_t least = checks_of_step(few), most = checks_of_step(many);
    // at least once per pair of bodies, and regularly during iterations
    const auto& report = many.dynamics()->report;
    CHECK(most > least);
    CHECK(most >= many.dynamics()->manifolds.size() + static_cast<uint64_t>(report.iterations) / 8);
  }
}

TEST_CASE("a failed step leaves the world unchanged: ODE has a limited number of contacts") {
  World world = crowd(9, DynamicsEngine::ode);
  const Moment before(world);
  std::string said;
  try {
    Stepper(world).run(dt);
  } catch (const Error& error) {
    said = error.what();
    CHECK(error.kind() == ErrorKind::limit);
  }
  CHECK(said.starts_with(
      "dynamics: engine 'ode': expected at most 1000 contact points in a step, got "));
  CHECK(Moment(world) == before);
  World few = crowd(2, DynamicsEngine::ode);
  Stepper(few).run(dt);
  CHECK(few.time() == dt);
}
