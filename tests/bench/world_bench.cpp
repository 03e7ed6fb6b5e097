#include "bench/world_bench.h"

#include <fmt/format.h>

#include <cmath>

#include "clench/base/random.h"
#include "clench/model/find.h"
#include "support/meshes.h"
#include "support/robots.h"

namespace clench::bench {

static World gravel(int count) {
  Random random(7);
  const BodySpec stone = test::body_spec("stone", test::box(0.02, 0.015, 0.01));
  World world;
  // one stone per cube of 25 mm
  const double room = 0.5 * 0.025 * std::cbrt(count);
  for (int i = 0; i < count; ++i)
    world.add_body(
        stone, BodyKind::object,
        {test::random_turn(random),
         {random.uniform(-room, room), random.uniform(-room, room), random.uniform(-room, room)}});
  return world;
}

// without the broad phase
static std::vector<BodyPair> colliding_of_all(const World& world) {
  std::vector<BodyPair> out;
  const auto& all = world.bodies();
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = i + 1; j < all.size(); ++j) {
      const Body &a = world.body(all[i]), &b = world.body(all[j]);
      if (world.may_collide(all[i], all[j]) && sphere_gap(world, all[i], all[j]) <= 0 &&
          colliding(*a.shape, *b.shape, world.pose(all[i]).inverse() * world.pose(all[j])))
        out.emplace_back(all[i], all[j]);
    }
  return out;
}

void measure_worlds(int most, Report& report) {
  for (int count = 10; count <= most; count *= 10) {
    const World world = gravel(count);
    Times sweep, all;
    const auto per_body = [&](Times& times, const char* who, auto&& act) {
      const double start = now();
      auto answer = act();
      times[who].push_back((now() - start) / count);
      return answer;
    };
    const auto name = fmt::format("{} bodies", count);
    std::vector<BodyPair> found;
    QueryContext context;
    for (int i = 0; i < 5; ++i) {
      per_body(sweep, "ours", [&] { return near_bodies(world, 0, context); });
      found = per_body(all, "ours", [&] { return colliding_pairs(world); });
    }
    if (count <= 1000) {
      const auto slow = per_body(all, "all pairs", [&] { return colliding_of_all(world); });
      report.check(slow == found, name + ": colliding pairs");
    }
    report.add("world: near pairs, us a body", name, sweep);
    report.add("world: colliding pairs, us a body", name, all);
  }
}

}  // namespace clench::bench
