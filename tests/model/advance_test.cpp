#include "clench/model/advance.h"

#include "support/robots.h"

using namespace clench;
using namespace clench::test;

TEST_CASE("a motion with endless small steps stops at the iteration limit") {
  World world;
  world.add_body(body_spec("table", moved(box(40, 1, 0.1), {0, 0, -0.05})), BodyKind::object, {});
  const auto table = world.bodies()[0];
  const double height = 0.01 + 5e-5;
  const auto block = world.add_body(body_spec("block", box(0.02, 0.02, 0.02)), BodyKind::object,
                                    Pose::translation({0, 0, height}));
  std::vector<PairBound> watches{{.a = block, .b = table, .speed = 10}};
  int queries = 0;
  const auto place = [&](double s) {
    world.set_pose(block, Pose::translation({10 * s, 0, height}));
  };
  const Advance end = advance(world, watches, 1, place, queries, 1000);
  CHECK(end.iteration_limit);
  CHECK(end.s < 1);
  // steps of half the gap, or of the excess over the target gap: about 30 um each
  CHECK(end.s * 10 == doctest::Approx(1000 * 3e-5).epsilon(0.01));
  CHECK(world.pose(block).position.x() == 10 * end.s);
}
