#include "clench/model/near_bodies.h"

#include <algorithm>
#include <ranges>
#include <set>

#include "clench/model/find.h"
#include "support/meshes.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

// brute-force reference: all pairs of two groups, each once, in their order
std::vector<BodyPair> all_pairs(const World& world, std::span<const Id<Body>> a,
                                std::span<const Id<Body>> b) {
  std::vector<BodyPair> out;
  std::set<BodyPair> seen;
  for (const auto i : a)
    for (const auto j : b)
      if (world.may_collide(i, j) && seen.insert(std::minmax(i, j)).second) out.emplace_back(i, j);
  return out;
}

double gap(const World& world, const BodyPair& pair) {
  return distance(world, std::array{pair.first}, std::array{pair.second}).distance;
}

std::vector<BodyPair> nearer_than(const World& world, std::vector<BodyPair> pairs, double reach) {
  std::erase_if(pairs, [&](const BodyPair& pair) { return gap(world, pair) > reach; });
  return pairs;
}

World heap(Random& random, int count, double room) {
  World world;
  for (int i = 0; i < count; ++i) {
    const double size = i % 10 == 0 ? 0.5 : random.uniform(0.05, 0.3);
    Mesh mesh = box(size, 0.6 * size, 0.4 * size);
    // not about its own origin
    for (auto& p : mesh.vertices) p += Eigen::Vector3d(0.1, 0, -0.2);
    world.add_body(body_spec("box", mesh), BodyKind::object,
                   {random_turn(random), random_point(random, room)});
  }
  return world;
}

}  // namespace

TEST_CASE(
    "the first colliding pairs equal those of a search of all pairs, for few bodies and for many") {
  Random random(7);
  for (const int count : {40, 90}) {
    World world = heap(random, count, 0.3);
    world.set_collision(false, world.bodies()[0], world.bodies()[1]);
    const auto all = colliding_pairs(world);
    REQUIRE(all.size() > 10);
    for (const size_t max : {size_t{0}, size_t{1}, size_t{7}, all.size(), all.size() + 1}) {
      const auto first = first_colliding_pairs(world, max, &world.context());
      CHECK(std::ranges::equal(first, all | std::views::take(max)));
    }
  }
}

TEST_CASE("the sweep finds all pairs within its reach, in the order of all pairs") {
  Random random(1);
  size_t found = 0, looked_at = 0, possible = 0;
  // few enough to be tested one by one, and more
  for (const auto& [reach, count] :
       {std::pair(0.0, 40), {0.01, 40}, {0.2, 40}, {0.0, 90}, {0.05, 90}}) {
    World world = heap(random, count, 0.3);
    world.set_collision(false, world.bodies()[3]);
    world.set_collision(false, world.bodies()[5], world.bodies()[6]);
    const auto& all = world.bodies();
    const auto every = all_pairs(world, all, all),
               near = near_bodies(world, reach, world.context());
    const auto expected = nearer_than(world, every, reach);
    CHECK(nearer_than(world, near, reach) == expected);
    // two groups that share bodies, one of them unsorted and with a repeated body
    std::vector<Id<Body>> a(all.begin(), all.begin() + 25), b(all.rbegin(), all.rbegin() + 25);
    b.push_back(b[2]);
    CHECK(nearer_than(world, near_bodies(world, a, b, reach, world.context()), reach) ==
          nearer_than(world, all_pairs(world, a, b), reach));
    found += expected.size(), looked_at += near.size(), possible += every.size();
  }
  CHECK(found > 50);
  CHECK(looked_at < possible);
}

TEST_CASE("colliding pairs equal those of a search of all pairs, also far from the origin") {
  Random random(2);
  World world = heap(random, 60, 0.25);
  const auto near_origin = colliding_pairs(world);
  CHECK(near_origin == nearer_than(world, all_pairs(world, world.bodies(), world.bodies()), 0));
  CHECK(near_origin.size() > 10);
  for (const auto id : world.bodies()) {
    Pose X = world.pose(id);
    X.position += Eigen::Vector3d(5e5, -3e5, 8e5);
    world.set_pose(id, X);
  }
  CHECK(colliding_pairs(world) ==
        nearer_than(world, all_pairs(world, world.bodies(), world.bodies()), 0));
}

TEST_CASE("bodies without geometry and empty groups have no near pairs") {
  World world;
  CHECK(near_bodies(world, 1, world.context()).empty());
  BodySpec nothing;
  nothing.name = "nothing";
  const auto one = world.add_body(body_spec("box", box(1, 1, 1)), BodyKind::object, {});
  world.add_body(nothing, BodyKind::object, {});
  CHECK(near_bodies(world, 1, world.context()).empty());
  CHECK(near_bodies(world, std::array{one}, {}, 1, world.context()).empty());
  CHECK(near_bodies(world, std::array{one}, std::array{one}, 1, world.context()).empty());
}

TEST_CASE("a context with a cached sweep finds the pairs of a new one") {
  Random random(2);
  World world = heap(random, 90, 0.3);
  size_t found = 0;
  const auto check = [&] {
    QueryContext fresh;
    const auto near = near_bodies(world, 0.01, fresh);
    CHECK(near_bodies(world, 0.01, world.context()) == near);
    found += near.size();
  };
  for (int round = 0; round < 10; ++round) {
    // some move slightly; sometimes one is far away, and another axis is the widest
    for (const auto id : world.bodies()) {
      Pose X = world.pose(id);
      X.position += random_point(random, 0.02);
      world.set_pose(id, X);
    }
    if (round % 3 == 2) {
      Pose X = world.pose(world.bodies()[round]);
      X.position[round % 2] += 50;
      world.set_pose(world.bodies()[round], X);
    }
    check();
  }
  // the model changes: another body reuses an index, and the context must grow
  world.remove(world.bodies()[7]);
  check();
  for (int i = 0; i < 20; ++i)
    world.add_body(body_spec("more", box(0.1, 0.1, 0.1)), BodyKind::object,
                   {random_turn(random), random_point(random, 0.3)});
  check();
  CHECK(found > 1000);
}
