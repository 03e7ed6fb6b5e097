// Clones and snapshots share unchanged data: changes of one are not visible in others.
#include <map>
#include <thread>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/model/find.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

/// Worlds of one family, and snapshots of them, each with the fingerprint that it must keep.
struct Family {
  struct Moment {
    std::shared_ptr<const Snapshot> snapshot;
    uint64_t hash;
  };
  Random random;
  std::vector<World> worlds;
  std::vector<uint64_t> hashes;
  std::vector<Moment> moments;
  std::map<Id<Body>, std::string> names;  // of all bodies ever added
  int made = 0;

  explicit Family(uint64_t seed) : random(seed), worlds(1), hashes{worlds[0].hash()} {}
  size_t any(size_t count) {
    return static_cast<size_t>(random.uniform(0, 1) * static_cast<double>(count)) % count;
  }
  void change(World& world);
  void step();
  void check() const;
};

void Family::change(World& world) {
  const auto& bodies = world.bodies();
  const double what = random.uniform(0, 1);
  if (what < 0.25 || bodies.empty()) {
    const std::string name = "thing " + std::to_string(made++);
    const auto id =
        world.add_body(body_spec(name, box(0.1, 0.1, 0.1)), BodyKind::object,
                       Pose::translation({random.normal(), random.normal(), random.normal()}));
    names[id] = name;
  } else if (what < 0.35) {
    RobotSpec spec = two_finger();
    spec.name = "hand " + std::to_string(made++);
    const auto id = world.add_robot(spec, {});
    for (const auto part : world.bodies_of(id)) names[part] = world.body(part).name;
  } else if (what < 0.45 && world.bodies().size() > 3) {
    const Id<Body> body = bodies[any(bodies.size())];
    if (world.body(body).robot)
      world.remove(Id<Robot>(world.body(body).robot));
    else
      world.remove(Id<Body>(body));
  } else if (what < 0.6) {
    for (const auto robot : world.robots())
      world.set_dofs(robot, Eigen::Vector2d(random.uniform(0, 1), random.uniform(0, 1)));
  } else if (what < 0.7) {
    for (const auto robot : world.robots()) {
      const std::vector<JointPosition> own = {0.1, std::nullopt, std::nullopt, 0.2};
      world.set_dofs_unchecked(robot, Eigen::Vector2d(0.5, random.uniform(0, 1)), own);
    }
  } else if (what < 0.8) {
    world.set_mass(bodies[any(bodies.size())], random.uniform(1, 2));
  } else if (what < 0.9) {
    world.set_collision(random.uniform(0, 1) < 0.5, bodies[any(bodies.size())]);
  } else {
    world.set_friction("wood", "glass", {random.uniform(0.1, 1), 0.1});
  }
}

void Family::step() {
  const size_t w = any(worlds.size());
  const double what = random.uniform(0, 1);
  if (what < 0.6) {
    change(worlds[w]);
    hashes[w] = worlds[w].hash();
  } else if (what < 0.75) {
    moments.push_back({worlds[w].snapshot(), hashes[w]});
  } else if (what < 0.85 && worlds.size() < 6) {
    worlds.push_back(World(worlds[w]));
    hashes.push_back(hashes[w]);
  } else if (!moments.empty()) {
    const Moment& moment = moments[any(moments.size())];
    worlds[w].restore(*moment.snapshot);
    hashes[w] = moment.hash;
  }
}

void Family::check() const {
  for (size_t w = 0; w < worlds.size(); ++w) {
    CHECK(worlds[w].hash() == hashes[w]);
    // an id denotes the same body in all worlds in which it exists
    for (const auto& [id, name] : names)
      if (worlds[w].alive(id)) CHECK(worlds[w].body(id).name == name);
  }
}

}  // namespace

TEST_CASE(
    "changes of one of many clones are invisible to the others, and a snapshot can be restored "
    "into each of them") {
  for (uint64_t seed = 0; seed < 8; ++seed) {
    Family family(seed);
    for (int step = 0; step < 120; ++step) {
      family.step();
      family.check();
    }
    CHECK(family.worlds.size() > 2);
    CHECK(family.moments.size() > 5);
  }
}

TEST_CASE("a snapshot of another world is rejected") {
  World world, other;
  const auto hash = world.hash();
  CHECK_THROWS_WITH_AS(world.restore(*other.snapshot()),
                       "world: the snapshot belongs to another world, of which this is no clone",
                       Error);
  CHECK(world.hash() == hash);
  World clone = world, second = clone;
  clone.add_body(body_spec("a", box(1, 1, 1)), BodyKind::object, {});
  second.restore(*clone.snapshot());
  CHECK(second.hash() == clone.hash());
}

TEST_CASE("clones changed by parallel threads equal clones changed one after the other") {
  World world;
  const auto hand = world.add_robot(two_finger(), {});
  const auto thing = world.add_body(body_spec("thing", box(0.02, 0.02, 0.02)), BodyKind::object,
                                    Pose::translation({0, 0.06, 0}));
  const auto snapshot = world.snapshot();
  const auto work = [&](World& clone, int seed) {
    Random random(static_cast<uint64_t>(seed));
    uint64_t hash = 0;
    for (int i = 0; i < 50; ++i) {
      clone.restore(*snapshot);
      clone.set_dofs(hand, Eigen::Vector2d(random.uniform(0, 1), random.uniform(0, 1)));
      clone.set_mass(thing, random.uniform(1, 2));
      const auto extra = clone.add_body(body_spec("extra", box(0.01, 0.01, 0.01)),
                                        BodyKind::obstacle, Pose::translation({0.1, 0, 0}));
      hash = hash * 31 + clone.hash() + colliding_pairs(clone).size() + contacts(clone).size();
      clone.remove(extra);
    }
    return hash;
  };
  constexpr int count = 8;
  std::vector<uint64_t> serial, parallel(count);
  std::vector<World> clones(count, world);
  for (int i = 0; i < count; ++i) {
    World clone = world;
    serial.push_back(work(clone, i));
  }
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i)
    threads.emplace_back([&, i] { parallel[i] = work(clones[i], i); });
  for (auto& thread : threads) thread.join();
  CHECK(serial == parallel);
}
