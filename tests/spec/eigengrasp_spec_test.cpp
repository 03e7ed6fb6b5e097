#include "clench/spec/eigengrasp_spec.h"

#include "clench/base/error.h"

using namespace clench;
using Eigen::VectorXd;

static EigengraspSet set_of(std::vector<VectorXd> vectors) {
  EigengraspSet set;
  set.dofs = static_cast<int>(vectors.front().size());
  for (auto& v : vectors) set.grasps.push_back({v, 0.5, std::nullopt});
  return set;
}

static VectorXd vec(double x, double y, double z) { return Eigen::Vector3d(x, y, z); }

static void check_set_refused(const EigengraspSet& set, const char* sentence) {
  CHECK_THROWS_WITH_AS(check_eigengrasps(set, "s"), sentence, Error);
}

TEST_CASE("the identity has a unit vector per DOF and is valid") {
  const auto set = identity_eigengrasps(4);
  CHECK(set.grasps.size() == 4);
  CHECK(set.grasps[2].vector == VectorXd(VectorXd::Unit(4, 2)));
  CHECK_NOTHROW(check_eigengrasps(set, "s"));
}

TEST_CASE("invalid sets are rejected in one sentence") {
  check_set_refused({}, "s: expected at least one eigengrasp, got none");
  auto set = set_of({vec(1, 0, 0), vec(0, 0, 0)});
  check_set_refused(set, "s: eigengrasp 2: expected a vector other than zero, got one of length 0");
  set.grasps[1].vector = VectorXd::Zero(2);
  check_set_refused(set, "s: eigengrasp 2: expected 3 numbers, got 2");
  set.grasps[1].vector = vec(0, NAN, 1);
  check_set_refused(set,
                    "s: eigengrasp 2: number 2: expected a number from -1e+30 to 1e+30, got nan");
  set.grasps[1].vector = vec(1, 1, 0);
  set.grasps[1].eigenvalue = INFINITY;
  check_set_refused(set,
                    "s: eigengrasp 2: eigenvalue: expected a number from -1e+30 to 1e+30, got inf");
  set.grasps[1].eigenvalue = 1;
  set.grasps[1].limits = {2, 1};
  check_set_refused(set, "s: eigengrasp 2: min 2 exceeds max 1");
  set.grasps[1].limits = {NAN, 1};
  check_set_refused(set, "s: eigengrasp 2: limit: expected a number from -1e+30 to 1e+30, got nan");
  set.grasps[1].limits.reset();
  set.origin = VectorXd::Zero(2);
  check_set_refused(set, "s: origin: expected 3 numbers, got 2");
  set.origin.reset();
  set.norm = vec(1, 0, 1);
  check_set_refused(set, "s: norm: number 2: expected a scale other than 0, got 0");
}

TEST_CASE("an eigengrasp that is a linear combination of others is rejected, with its index") {
  auto set = set_of({vec(1, 2, 3), vec(0, 1, 1), vec(2, 5, 7)});
  check_set_refused(set, "s: eigengrasp 3: it is a sum of those before it");
  CHECK_THROWS_WITH_AS(check_eigengrasps(set, "s", {.grasps = {"a:1", "a:4", "a:7"}}),
                       "a:7: eigengrasp 3: it is a sum of those before it", Error);
  set.grasps[2].vector = vec(2, 5, 7.001);
  CHECK_NOTHROW(check_eigengrasps(set, "s"));
  // more than the number of DOFs cannot be independent
  set.grasps.push_back({vec(5, 5, 5), 0.5, std::nullopt});
  check_set_refused(set, "s: eigengrasp 4: it is a sum of those before it");
}
