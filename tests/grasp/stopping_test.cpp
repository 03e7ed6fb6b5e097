// Long calls end after a stop request, and leave no partial results behind.
#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/base/progress.h"
#include "clench/base/random.h"
#include "clench/base/watched.h"
#include "clench/grasp/measure/robustness.h"
#include "clench/grasp/wrench/grasp.h"
#include "clench/grasp/wrench/projection.h"
#include "clench/grasp/wrench/sum_volume.h"
#include "clench/grasp/wrench/wrench_space.h"

using namespace clench;

namespace {

struct Silent : Watcher {
  void show(double, std::string_view) override {}
};

// contacts all around a ball
WrenchSpace ball_of(int count, int edges, WrenchNorm norm) {
  Random random(3);
  std::vector<UnitWrenches> contacts;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d n =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    contacts.push_back(
        unit_wrenches({.p_O = n, .n_O = -n, .mu = 0.5, .torsion_radius = 0.1}, {.edges = edges}));
  }
  return WrenchSpace(std::move(contacts), {.norm = norm});
}

}  // namespace

TEST_CASE("a stopped wrench space later gives results bit-identical to those of a new one") {
  const auto watcher = std::make_shared<Silent>();
  const Progress progress(watcher);
  for (const auto norm : {WrenchNorm::l1, WrenchNorm::linf})
    for (const int edges : {6, round_edges}) {
      const int count = norm == WrenchNorm::l1 ? 8 : 4;
      // otherwise too many cells
      const bool measured = norm == WrenchNorm::l1 || edges != round_edges;
      const WrenchSpace stopped = ball_of(count, edges, norm), fresh = ball_of(count, edges, norm);
      watcher->stop();
      CHECK_THROWS_AS(stopped.epsilon(progress), Stopped);
      CHECK_THROWS_AS(stopped.weakest(progress), Stopped);
      CHECK_THROWS_AS(stopped.is_force_closure(progress), Stopped);
      if (measured) CHECK_THROWS_AS(stopped.volume(progress), Stopped);
      watcher->take_stop();
      CHECK(stopped.epsilon(progress) == fresh.epsilon());
      CHECK(stopped.is_force_closure() == fresh.is_force_closure());
      if (measured) CHECK(stopped.volume(progress) == fresh.volume());
      CHECK(stopped.weakest().direction == fresh.weakest().direction);
      CHECK(fresh.epsilon() > 0);
    }
}

TEST_CASE("bounds of epsilon are valid after a stop") {
  const auto watcher = std::make_shared<Silent>();
  const WrenchSpace space = ball_of(8, round_edges, WrenchNorm::l1);
  CHECK(space.is_force_closure());
  watcher->stop();
  const EpsilonBounds early = space.epsilon_bounds({.tolerance = 1e-9}, Progress(watcher));
  CHECK_FALSE(early.converged);
  const double epsilon = ball_of(8, round_edges, WrenchNorm::l1).epsilon();
  CHECK(early.lower <= epsilon);
  CHECK(epsilon <= early.upper);
  CHECK(space.epsilon() == epsilon);
}

TEST_CASE("a stopped projection has no result") {
  const auto watcher = std::make_shared<Silent>();
  watcher->stop();
  ProjectionOptions options{.projected = {3, 4, 5}};
  options.progress = Progress(watcher);
  const WrenchSpace space = ball_of(8, 8, WrenchNorm::l1);
  CHECK_THROWS_AS(project(space, options), Stopped);
  watcher->take_stop();
  CHECK(project(space, options).volume > 0);
}

TEST_CASE(
    "force closure of thousands of edges is decided early, with a check for stops at each "
    "direction") {
  const WrenchSpace space = ball_of(8, 200, WrenchNorm::l1);
  const Watched watched{Progress()};
  CHECK(space.is_force_closure());
  const uint64_t checks = watched.checks();
  CHECK(checks > 10);
  CHECK(checks < 2000);
  // the same result as with fewer edges
  CHECK(ball_of(8, 8, WrenchNorm::l1).is_force_closure());
}

TEST_CASE("epsilon stops at any direction, and later gives the same result as without a stop") {
  const WrenchSpace space = ball_of(6, 20, WrenchNorm::l1);
  for (const uint64_t at : {1, 10, 30}) {
    Watched watched{Progress()};
    watched.stop_at(at);
    CHECK_THROWS_AS(space.epsilon(), Stopped);
  }
  CHECK(space.epsilon() == ball_of(6, 20, WrenchNorm::l1).epsilon());
}

TEST_CASE("the product of contacts and edges is limited") {
  GraspSpec grasp;
  for (int i = 0; i < 101; ++i) grasp.points.push_back({});
  grasp.options.edges = 1000;
  CHECK_THROWS_WITH_AS(wrench_space(grasp),
                       "wrench space: expected at most 100000 edges of all contacts, got more of "
                       "101 contacts of 1000 edges; "
                       "give fewer edges, or edges = \"exact\"",
                       Error);
  try {
    wrench_space(grasp);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::limit);
  }
  grasp.points.pop_back();
  CHECK(wrench_space(grasp).contacts().size() == 100);
}
