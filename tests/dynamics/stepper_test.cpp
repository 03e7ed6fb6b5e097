#include "clench/dynamics/stepper.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

static World stack() {
  World world;
  world.add_body(body_spec("table", box(1, 1, 0.1)), BodyKind::obstacle,
                 Pose::translation({0, 0, -0.05}));
  for (int i = 0; i < 4; ++i)
    world.add_body(body_spec("box", box(0.06, 0.06, 0.04)), BodyKind::object,
                   Pose::translation({0, 0, 0.021 + i * 0.041}));
  return world;
}

TEST_CASE("a world at rest costs no iterations, and stays exactly at rest") {
  World world = stack();
  Stepper stepper(world);
  stepper.run(1);
  const auto before = world.dynamics()->report.iterations;
  const Pose top = world.pose(world.bodies().back());
  stepper.run(1);
  CHECK(world.dynamics()->report.iterations == before);
  CHECK(world.pose(world.bodies().back()) == top);
  for (const auto id : world.bodies()) CHECK(world.twist(id).is_zero());
}

TEST_CASE("a duration that is a sum of many steps takes as many steps") {
  World world;
  Stepper stepper(world);
  double time = 0;
  for (int i = 0; i < 30000; ++i) {
    stepper.run(0.001);
    time += 0.001;
  }
  CHECK(world.dynamics()->report.steps == 30000);
  CHECK(world.time() == time);
}
