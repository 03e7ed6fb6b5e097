#include "clench/dynamics/stepper.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

TEST_CASE("a time that is a sum of many steps has as many steps") {
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
