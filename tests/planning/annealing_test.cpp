#include "clench/planning/search/annealing.h"

#include "clench/base/error.h"
#include "clench/model/find.h"
#include "clench/planning/energy/contact_energy.h"
#include "clench/planning/search/run_together.h"
#include "planning/scene.h"

using namespace clench;
using namespace clench::test;

namespace {

// the same energy, ignoring bounds
struct Unbounded : Energy {
  EnergyPtr inner;
  explicit Unbounded(EnergyPtr energy) : inner(std::move(energy)) {}
  double bounded_value(World& world, double) override { return inner->value(world, infinite); }
  EnergyPtr clone() const override { return std::make_unique<Unbounded>(inner->clone()); }
};

struct TestChain {
  std::unique_ptr<World> world;
  std::unique_ptr<Annealing> search;
};

TestChain chain(const HandScene& scene, uint64_t seed, bool bounded = true,
                AnnealingOptions options = {}) {
  TestChain out{std::make_unique<World>(scene.world), nullptr};
  const HandAndObject who{scene.hand, scene.object};
  EnergyPtr energy = std::make_unique<ContactEnergy>(*out.world, who, ContactEnergy::Options{});
  if (!bounded) energy = std::make_unique<Unbounded>(std::move(energy));
  options.seed = seed;
  options.best.radius = scene.world.body(scene.object).max_radius();
  out.search = std::make_unique<Annealing>(
      *out.world, who, SearchSpace(scene.robot(), scene.state()), std::move(energy), options);
  return out;
}

bool same(const Annealing& a, const Annealing& b) {
  if (a.values() != b.values() || a.energy() != b.energy()) return false;
  const auto &x = a.best().states(), &y = b.best().states();
  return std::ranges::equal(x, y, [](const FoundState& s, const FoundState& t) {
    return s.values == t.values && s.energy == t.energy && s.step == t.step;
  });
}

}  // namespace

TEST_CASE("a chain does not depend on the division of its steps, on bounds, or on threads") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  TestChain whole = chain(scene, 7), cut = chain(scene, 7), unbounded = chain(scene, 7, false);
  CHECK(whole.search->run(600) == 600);
  for (int i = 0; i < 6; ++i) CHECK(cut.search->run(100) == 100);
  CHECK(unbounded.search->run(600) == 600);
  CHECK(same(*whole.search, *cut.search));
  CHECK(same(*whole.search, *unbounded.search));

  std::vector<TestChain> chains;
  std::vector<Share> shares;
  for (int i = 0; i < 5; ++i) chains.push_back(chain(scene, i == 3 ? 7 : 100 + i));
  for (TestChain& c : chains) shares.push_back({c.search.get(), 600});
  run_together(shares, 3);
  CHECK(same(*whole.search, *chains[3].search));
  CHECK_FALSE(same(*whole.search, *chains[0].search));
  for (const Share& share : shares) CHECK(share.taken == 600);
}

TEST_CASE(
    "every counted step is collision-free, and every stored state is collision-free and within the "
    "ranges") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  TestChain c = chain(scene, 1);
  CHECK(c.search->run(2000) == 2000);
  CHECK(c.search->counts().steps == 2000);
  CHECK(c.search->step() == AnnealingSchedule().first_step + 2000);
  REQUIRE(c.search->best().states().size() > 3);
  double before = -1;
  for (const FoundState& found : c.search->best().states()) {
    c.world->set_posture(scene.hand, found.state.X_RH, found.state.dofs);
    CHECK_FALSE(collides(*c.world));
    CHECK(found.energy >= before);
    before = found.energy;
    for (int i = 0; i < found.values.size(); ++i) {
      CHECK(found.values[i] >= c.search->space().variables()[i].min);
      CHECK(found.values[i] <= c.search->space().variables()[i].max);
    }
  }
  CHECK(c.search->best().states()[0].energy < c.search->first_energy() / 2);
}

TEST_CASE("the mean of neighbors is shifted towards a target, and fixed variables stay") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  World world = scene.world;
  SearchSpace space(scene.robot(), scene.state());
  for (Variable& v : space.variables()) v.fixed = v.name != "Tx";
  auto& tx = space.variables()[find_variable(space.variables(), "Tx")];
  tx.target = 0.2, tx.confidence = 0.9;
  double seen = 0;
  int count = 0;
  const int at = find_variable(space.variables(), "Tx");
  Annealing* watched = nullptr;
  EnergyPtr energy = std::make_unique<EnergyFunction>([&] {
    if (watched) ++count;
    return 0.0;
  });
  // high temperature: jumps are long
  Annealing search(world, {scene.hand, scene.object}, space, std::move(energy),
                   {.schedule = {.first_step = 0}, .collisions = false});
  watched = &search;
  const Values start = search.values();
  for (int i = 0; i < 50; ++i) search.run(1), seen += search.values()[at] / 50;
  CHECK(count == 50);
  CHECK(seen > 0.05);
  for (int i = 0; i < start.size(); ++i)
    if (i != at) CHECK(search.values()[i] == start[i]);
}

TEST_CASE("the search stays away from states to avoid") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  TestChain c = chain(scene, 2);
  c.search->run(500);
  const FoundState best = c.search->best().states()[0];
  c.search->best().avoid(best.state);
  c.search->go_to(best.values);
  c.search->best().clear();
  c.search->run(500);
  CHECK(c.search->counts().avoided > 0);
  for (const FoundState& found : c.search->best().states())
    CHECK(c.search->space().distance(found.state, best.state, c.search->best().options().radius,
                                     true) >= 0.2);
}

TEST_CASE("a chain that cannot move reports its number of steps") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  World world = scene.world;
  SearchSpace space(scene.robot(), scene.state());
  // the base inside the mug
  for (const char* name : {"Tx", "Ty", "Tz"}) {
    Variable& v = space.variables()[find_variable(space.variables(), name)];
    v.min = v.value = 0, v.max = 1e-6;
  }
  Annealing search(world, {scene.hand, scene.object}, space,
                   std::make_unique<EnergyFunction>([] { return 1.0; }), {.max_tries = 1});
  CHECK(search.run(10) == 0);
  CHECK(search.energy() == infinite);
  CHECK(search.counts().in_collision > 0);
  CHECK(search.counts().stuck == 10000);
}

TEST_CASE("the five schedules equal the original's, and their temperatures decrease") {
  const AnnealingSchedule usual = annealing_schedule("default");
  // planners.md, section 5: T0 exp(-YC k^(1/YD)) with 1e6, 7, 8 at 30000
  CHECK(usual.neighbor_temperature(30000) ==
        doctest::Approx(1e6 * std::exp(-7 * std::pow(30000, 0.125))));
  for (const char* name : {"default", "loop", "modified", "strict", "online"}) {
    const AnnealingSchedule s = annealing_schedule(name);
    CHECK(s.error_temperature(s.first_step + 1000) < s.error_temperature(s.first_step + 1));
  }
  CHECK(annealing_schedule("strict").t0 == 10);
  CHECK_THROWS_WITH_AS(annealing_schedule("strickt"),
                       "annealing: no schedule 'strickt', expected one of default, loop, modified, "
                       "strict, online; did you mean 'strict'?",
                       Error);
}

TEST_CASE("invalid options of a search are rejected") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  const auto with = [&](AnnealingOptions options) { chain(scene, 1, true, options); };
  CHECK_THROWS_WITH_AS(with({.schedule = {.t0 = 0}}), "annealing: t0 must be > 0, got 0", Error);
  CHECK_THROWS_WITH_AS(with({.schedule = {.first_step = -1}}),
                       "annealing: first_step must be >= 0, got -1", Error);
  CHECK_THROWS_WITH_AS(with({.max_tries = 0}), "annealing: max_tries must be >= 1, got 0", Error);
  CHECK_THROWS_WITH_AS(with({.best = {.size = 0}}), "best list: size: expected 1 to 1000000, got 0",
                       Error);
  CHECK_THROWS_WITH_AS(with({.best = {.distance = -1}}), "best list: distance must be >= 0, got -1",
                       Error);
  World world = scene.world;
  SearchSpace space(scene.robot(), scene.state(),
                    {.position = PositionKind::fixed, .posture = PostureKind::fixed});
  CHECK_THROWS_WITH_AS(Annealing(world, {scene.hand, scene.object}, space,
                                 std::make_unique<EnergyFunction>([] { return 1.0; })),
                       "annealing: every variable is fixed", Error);
  TestChain a = chain(scene, 1);
  std::vector<Share> twice{{a.search.get(), 1}, {a.search.get(), 1}};
  CHECK_THROWS_WITH_AS(run_together(twice, 1), "searches that run at once need separate worlds",
                       Error);
  CHECK_THROWS_WITH_AS(run_together(std::span(twice).first(1), 0),
                       "threads: expected 1 to 1024, got 0", Error);
}

TEST_CASE("the best list keeps the best states, no two of them similar") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  const SearchSpace space(scene.robot(), scene.state());
  BestList list({.size = 2, .distance = 0.1, .radius = 1});
  const auto at = [&](double x, double energy) {
    FoundState found{space.start(), scene.state(), energy, 0};
    found.state.X_RH.position.x() += x;
    return list.add(space, found);
  };
  CHECK(at(0, 5));
  CHECK(at(1, 4));
  CHECK_FALSE(at(0.05, 6));  // similar to a better one
  CHECK(at(0.05, 3));        // better than the similar one
  CHECK(list.states().size() == 2);
  CHECK(list.states()[0].energy == 3);
  CHECK_FALSE(at(2, 9));
  CHECK(at(3, 1));
  CHECK(list.states().back().energy == 3);
}
