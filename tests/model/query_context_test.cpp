// Cached data of a context do not change any bit of a result.
#include "clench/model/query_context.h"

#include <thread>

#include "clench/base/random.h"
#include "clench/model/find.h"
#include "support/meshes.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

/// Results of all queries of a world, bit-exactly.
struct Answers {
  std::vector<BodyPair> colliding;
  bool any = false;
  std::vector<double> numbers;  // of contacts and of the nearest points of some pairs

  bool operator==(const Answers&) const = default;
};

void add(std::vector<double>& out, const Eigen::Vector3d& v) {
  out.insert(out.end(), v.begin(), v.end());
}

Answers ask(const World& world, QueryContext* context) {
  Answers out{colliding_pairs(world, context), collides(world, context), {}};
  for (const Contact& contact : contacts(world, context)) {
    add(out.numbers, contact.p_W), add(out.numbers, contact.n_W);
    out.numbers.push_back(contact.gap);
  }
  const auto& bodies = world.bodies();
  for (size_t i = 1; i < bodies.size(); ++i) {
    const std::array a{bodies[i - 1]}, b{bodies[i]};
    const BodyDistance d = distance(world, a, b, std::numeric_limits<double>::infinity(), context);
    out.numbers.push_back(d.distance);
    add(out.numbers, d.p_a), add(out.numbers, d.p_b);
  }
  return out;
}

World pile(Random& random, int count) {
  World world;
  world.add_robot(two_finger(), {});
  for (int i = 0; i < count; ++i)
    world.add_body(body_spec("thing", i % 2 ? ball(0.02) : box(0.03, 0.02, 0.04)), BodyKind::object,
                   {random_turn(random), random_point(random, 0.08)});
  return world;
}

void stir(World& world, Random& random) {
  for (const auto robot : world.robots())
    world.set_dofs(robot, Eigen::Vector2d(random.uniform(0, 1.5), random.uniform(0, 1.5)));
  for (const auto id : std::vector(world.bodies()))
    if (!world.body(id).robot && random.uniform(0, 1) < 0.5)
      // some far, some so that they nearly touch again
      world.set_pose(id, {random_turn(random), random_point(random, 0.1)});
  const auto& last = world.bodies().back();
  if (random.uniform(0, 1) < 0.3 && !world.body(last).robot && world.bodies().size() > 6)
    world.remove(Id<Body>(last));
  if (random.uniform(0, 1) < 0.3)
    world.add_body(body_spec("new", ball(0.015)), BodyKind::object,
                   Pose::translation(random_point(random, 0.08)));
  if (random.uniform(0, 1) < 0.3)
    world.set_collision(random.uniform(0, 1) < 0.7, world.bodies()[0], world.bodies().back());
}

}  // namespace

TEST_CASE(
    "a new context, a used one, one of another world and no context give bit-identical results") {
  Random random(1);
  size_t hits = 0;
  for (int round = 0; round < 4; ++round) {
    // a clone in which a body was replaced has another body at the same index
    World world = pile(random, 12), other = world, stranger = pile(random, 14);
    QueryContext used, both;
    std::vector<std::shared_ptr<const Snapshot>> moments;
    for (int step = 0; step < 25; ++step) {
      stir(world, random), stir(other, random), stir(stranger, random);
      if (step % 4 == 0) moments.push_back(world.snapshot());
      if (step % 5 == 4) world.restore(*moments[step % moments.size()]);
      QueryContext fresh;
      const Answers answers = ask(world, nullptr);
      hits += answers.colliding.size();
      CHECK(answers.any == !answers.colliding.empty());
      CHECK(ask(world, &fresh) == answers);
      CHECK(ask(world, &fresh) == answers);
      CHECK(ask(world, &used) == answers);
      ask(stranger, &both), ask(other, &both);
      CHECK(ask(world, &both) == answers);
      CHECK(ask(world, &world.context()) == answers);
    }
  }
  CHECK(hits > 100);
}

TEST_CASE("many threads read one world, each with its own context") {
  Random random(2);
  World world = pile(random, 15);
  stir(world, random);
  const World& fixed = world;
  const Answers answers = ask(fixed, nullptr);
  std::vector<Answers> read(4);
  std::vector<std::thread> threads;
  for (Answers& out : read)
    threads.emplace_back([&] {
      QueryContext context;
      for (int i = 0; i < 5; ++i) out = ask(fixed, &context);
    });
  for (auto& thread : threads) thread.join();
  for (const Answers& out : read) CHECK(out == answers);
}
