#include "clench/motion/eigengrasps.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/io/read/read.h"
#include "support/measured.h"
#include "support/robots.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

VectorXd vec(std::initializer_list<double> x) {
  return Eigen::Map<const VectorXd>(x.begin(), static_cast<int>(x.size()));
}

VectorXd random_vector(Random& random, int size) {
  VectorXd x(size);
  for (double& v : x) v = random.normal();
  return x;
}

struct Case {
  EigengraspSet set;
  std::vector<Range> limits;
};

Case random_case(Random& random, bool with_norm = true) {
  Case c;
  c.set.dofs = 2 + static_cast<int>(random.bits() % 20);
  const int count = 1 + static_cast<int>(random.bits() % c.set.dofs);
  for (int i = 0; i < count; ++i)
    c.set.grasps.push_back({random_vector(random, c.set.dofs), 0.5, std::nullopt});
  if (with_norm) {
    c.set.norm = random_vector(random, c.set.dofs).cwiseAbs() + VectorXd::Constant(c.set.dofs, 0.1);
    c.set.origin = random_vector(random, c.set.dofs);
  }
  for (int i = 0; i < c.set.dofs; ++i)
    c.limits.push_back({-1 - random.uniform(), 1 + random.uniform()});
  return c;
}

// sums of some twenty products of numbers below ten, and a solution with them: random sets with as
// many vectors as DOFs have condition numbers of up to a few thousand
constexpr double rounding = 1e-10;

}  // namespace

TEST_CASE("the posture of given amplitudes has these amplitudes") {
  for (uint64_t i = 0; i < 50; ++i) {
    Random random(21, i);
    const Case c = random_case(random);
    const Eigengrasps grasps(c.set, c.limits);
    const VectorXd a = random_vector(random, grasps.size());
    CHECK((grasps.amplitudes(grasps.posture(a)) - a).norm() < rounding * (1 + a.norm()));
    for (int k = 0; k < grasps.size(); ++k)
      CHECK(grasps.vectors().row(k).norm() == doctest::Approx(1));
  }
}

TEST_CASE("amplitudes give the nearest posture of the set, in the weighted norm") {
  for (uint64_t i = 0; i < 20; ++i) {
    Random random(22, i);
    const Case c = random_case(random);
    const Eigengrasps grasps(c.set, c.limits);
    const VectorXd q = random_vector(random, c.set.dofs);
    const auto gap = [&](const VectorXd& a) {
      return (grasps.posture(a) - q).cwiseQuotient(grasps.norm()).norm();
    };
    const VectorXd best = grasps.amplitudes(q);
    for (int k = 0; k < 20; ++k)
      CHECK(gap(best) <= gap(best + 0.1 * random_vector(random, grasps.size())) + rounding);
  }
}

TEST_CASE("free mode reaches the amplitudes and keeps the component outside of the set") {
  for (uint64_t i = 0; i < 50; ++i) {
    Random random(23, i);
    const Case c = random_case(random);
    const Eigengrasps grasps(c.set, c.limits);
    const VectorXd from = random_vector(random, c.set.dofs),
                   a = random_vector(random, grasps.size());
    const VectorXd q = grasps.posture(a, from);
    CHECK((grasps.amplitudes(q) - a).norm() < rounding * (1 + a.norm()));
    // the component outside: the posture minus the posture of its amplitudes
    const VectorXd rest = from - grasps.posture(grasps.amplitudes(from)),
                   rest_now = q - grasps.posture(grasps.amplitudes(q));
    CHECK((rest - rest_now).norm() < rounding * (1 + rest.norm() + a.norm()));
    // it is zero for a posture of the set, and both modes agree
    const VectorXd inside = grasps.posture(random_vector(random, grasps.size()));
    CHECK((grasps.posture(a, inside) - grasps.posture(a)).norm() < rounding * (1 + inside.norm()));
  }
}

TEST_CASE(
    "one eigengrasp per DOF: amplitudes are DOF values relative to the middle of their ranges") {
  World world;
  const auto hand = world.add_robot(two_finger(), {});
  const Eigengrasps grasps(world.robot(hand));
  REQUIRE(grasps.size() == 2);
  for (int d = 0; d < 2; ++d) {
    const auto [low, high] = world.robot(hand).limits[d];
    CHECK(grasps.origin()[d] == doctest::Approx((low + high) / 2));
    CHECK(grasps.range()[d][1] == doctest::Approx((high - low) / 2));
  }
  CHECK((grasps.amplitudes(vec({0.3, 0.5})) - (vec({0.3, 0.5}) - grasps.origin())).norm() < 1e-15);
  CHECK((grasps.posture(grasps.amplitudes(vec({0.3, 0.5}))) - vec({0.3, 0.5})).norm() < 1e-15);
}

TEST_CASE("the origin is moved into the limits") {
  EigengraspSet set = identity_eigengrasps(2);
  set.origin = vec({5, -5});
  CHECK(Eigengrasps(set, {{0, 1}, {-1, 1}}).origin() == vec({1, -1}));
  CHECK(Eigengrasps(set, {}).origin() == vec({5, -5}));
}

TEST_CASE("within the limits of an amplitude no DOF leaves its range, and beyond them one does") {
  for (uint64_t i = 0; i < 30; ++i) {
    Random random(24, i);
    const Case c = random_case(random);
    const Eigengrasps grasps(c.set, c.limits);
    VectorXd q(c.set.dofs);
    for (int d = 0; d < q.size(); ++d) q[d] = random.uniform(c.limits[d][0], c.limits[d][1]);
    const auto max_beyond = [&](int k, double amplitude) {
      VectorXd a = grasps.amplitudes(q);
      a[k] = amplitude;
      const VectorXd moved = grasps.posture(a, q);
      double worst = -1e9;
      for (int d = 0; d < q.size(); ++d)
        worst = std::max({worst, c.limits[d][0] - moved[d], moved[d] - c.limits[d][1]});
      return worst;
    };
    const auto limits = grasps.limits(q);
    for (int k = 0; k < grasps.size(); ++k)
      for (const double limit : limits[k]) {
        CHECK(max_beyond(k, limit) < rounding);
        const double now = grasps.amplitudes(q)[k];
        CHECK(max_beyond(k, limit + 0.01 * (limit > now ? 1 : -1)) > 0);
      }
  }
}

TEST_CASE("limits of a file take precedence, and a DOF that hardly moves limits nothing") {
  EigengraspSet set = identity_eigengrasps(2);
  set.grasps[0].limits = {-7, 8};
  set.grasps[1].vector = vec({1e-20, 1});
  const Eigengrasps grasps(set, {{0, 0}, {-1, 1}});
  CHECK(grasps.limits(vec({0, 0}))[0] == Range{-7, 8});
  CHECK(grasps.range()[0] == Range{-7, 8});
  CHECK(grasps.limits(vec({0, 0}))[1] == Range{-1, 1});
}

TEST_CASE("the range covers the amplitudes of all postures within the limits, and is attained") {
  for (uint64_t i = 0; i < 20; ++i) {
    Random random(25, i);
    const Case c = random_case(random);
    const Eigengrasps grasps(c.set, c.limits);
    const auto range = grasps.range();
    std::vector<Range> seen(grasps.size(), {1e9, -1e9});
    const int corners = c.set.dofs <= 8 ? 1 << c.set.dofs : 200;
    for (int k = 0; k < corners; ++k) {
      VectorXd q(c.set.dofs);
      for (int d = 0; d < q.size(); ++d)
        q[d] = c.limits[d][(c.set.dofs <= 8 ? k >> d : static_cast<int>(random.bits())) & 1];
      const VectorXd a = grasps.amplitudes(q);
      for (int g = 0; g < grasps.size(); ++g)
        seen[g] = {std::min(seen[g][0], a[g]), std::max(seen[g][1], a[g])};
    }
    for (int g = 0; g < grasps.size(); ++g) {
      const double slack = rounding * (1 + std::abs(range[g][0]) + std::abs(range[g][1]));
      CHECK(seen[g][0] >= range[g][0] - slack);
      CHECK(seen[g][1] <= range[g][1] + slack);
      if (c.set.dofs <= 8) CHECK(std::abs(seen[g][1] - range[g][1]) <= slack);
    }
  }
}

TEST_CASE("wrong counts and invalid numbers are rejected") {
  const Eigengrasps grasps(identity_eigengrasps(2), {{0, 1}, {0, 1}});
  CHECK_THROWS_WITH_AS(grasps.amplitudes(vec({1})), "eigengrasps: expected 2 DOF values, got 1",
                       Error);
  CHECK_THROWS_WITH_AS(grasps.posture(vec({1, 2, 3})), "eigengrasps: expected 2 amplitudes, got 3",
                       Error);
  CHECK_THROWS_WITH_AS(grasps.posture(vec({1, NAN})),
                       "eigengrasps: amplitudes: expected a number from -1e+30 to 1e+30, got nan",
                       Error);
  CHECK_THROWS_WITH_AS(Eigengrasps(identity_eigengrasps(2), {{0, 1}}),
                       "eigengrasps: expected a set for 1 DOFs, got one for 2", Error);
}

// --- principal components ---

namespace {

struct Component {
  double variance;
  VectorXd direction;
};

// Jacobi rotations of the covariance, entry by entry: slow and simple
// source  Golub & Van Loan (2013), Matrix computations, sec. 8.5
std::vector<Component> slow_components(const std::vector<VectorXd>& postures) {
  const int n = static_cast<int>(postures.front().size());
  VectorXd mean = VectorXd::Zero(n);
  for (const auto& q : postures) mean += q / static_cast<double>(postures.size());
  MatrixXd c = MatrixXd::Zero(n, n), v = MatrixXd::Identity(n, n);
  for (const auto& q : postures)
    c += (q - mean) * (q - mean).transpose() / static_cast<double>(postures.size() - 1);
  for (int sweep = 0; sweep < 60; ++sweep)
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        if (c(i, j) == 0) continue;
        const double angle = 0.5 * std::atan2(2 * c(i, j), c(j, j) - c(i, i));
        MatrixXd turn = MatrixXd::Identity(n, n);
        turn(i, i) = turn(j, j) = std::cos(angle);
        turn(i, j) = std::sin(angle);
        turn(j, i) = -std::sin(angle);
        c = turn.transpose() * c * turn;
        v = v * turn;
      }
  std::vector<Component> out;
  for (int i = 0; i < n; ++i) out.push_back({c(i, i), v.col(i)});
  std::sort(out.begin(), out.end(),
            [](const Component& a, const Component& b) { return a.variance > b.variance; });
  return out;
}

std::vector<VectorXd> random_postures(uint64_t seed, int count, int dofs) {
  Random random(31, seed);
  std::vector<VectorXd> out;
  for (int i = 0; i < count; ++i) {
    VectorXd q = random_vector(random, dofs);
    for (int d = 0; d < dofs; ++d) q[d] = 0.3 * q[d] * (d + 1) + 0.1 * q[0];
    out.push_back(q);
  }
  return out;
}

}  // namespace

TEST_CASE("principal components equal those of a slow decomposition of the covariance") {
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const int dofs = 2 + static_cast<int>(seed);
    const auto postures = random_postures(seed, 30, dofs);
    const auto set = principal_eigengrasps(postures);
    const auto slow = slow_components(postures);
    REQUIRE(static_cast<int>(set.grasps.size()) == dofs);
    for (int i = 0; i < dofs; ++i) {
      CHECK(set.grasps[i].eigenvalue == doctest::Approx(slow[i].variance).epsilon(1e-10));
      // up to the sign; eigenvalues of random postures are well separated
      CHECK(std::abs(set.grasps[i].vector.dot(slow[i].direction)) ==
            doctest::Approx(1).epsilon(1e-9));
      int largest = 0;
      set.grasps[i].vector.cwiseAbs().maxCoeff(&largest);
      CHECK(set.grasps[i].vector[largest] > 0);
    }
  }
}

TEST_CASE("as many components as the postures span reproduce every posture") {
  const auto postures = random_postures(9, 4, 7);
  const auto set = principal_eigengrasps(postures);
  CHECK(set.grasps.size() == 3);
  const Eigengrasps grasps(set, {});
  for (const auto& q : postures) CHECK((grasps.posture(grasps.amplitudes(q)) - q).norm() < 1e-12);
  CHECK(principal_eigengrasps(postures, 2).grasps.size() == 2);
}

TEST_CASE("the same postures give bit-identical components") {
  const auto postures = random_postures(2, 20, 6);
  const auto a = principal_eigengrasps(postures), b = principal_eigengrasps(postures);
  for (size_t i = 0; i < a.grasps.size(); ++i) CHECK(a.grasps[i].vector == b.grasps[i].vector);
}

TEST_CASE("postures without components are rejected") {
  CHECK_THROWS_WITH_AS(principal_eigengrasps({vec({1, 2})}),
                       "eigengrasps: expected at least 2 postures, got 1", Error);
  CHECK_THROWS_WITH_AS(principal_eigengrasps({vec({1, 2}), vec({1, 2})}),
                       "eigengrasps: expected postures that differ, got the same 2 times", Error);
  CHECK_THROWS_WITH_AS(principal_eigengrasps({vec({1, 2}), vec({1})}),
                       "eigengrasps: posture 2: expected 2 DOF values, got 1", Error);
  CHECK_THROWS_WITH_AS(
      principal_eigengrasps({vec({1, 2}), vec({1, NAN})}),
      "eigengrasps: posture 2: number: expected a number from -1e+30 to 1e+30, got nan", Error);
  CHECK_THROWS_WITH_AS(principal_eigengrasps({vec({1, 2}), vec({1, 3})}, 2),
                       "eigengrasps: count: 2 postures vary in 1 directions only, expected 2",
                       Error);
  CHECK_THROWS_WITH_AS(principal_eigengrasps({vec({1, 2}), vec({1, 3})}, 3),
                       "eigengrasps: count: expected 1 to 2, got 3", Error);
  CHECK_THROWS_WITH_AS(principal_eigengrasps({VectorXd(), VectorXd()}),
                       "eigengrasps: posture 1: expected DOF values, got none", Error);
}

// --- the original ---

TEST_CASE("24 postures of three hands have the amplitudes measured with the original") {
  REQUIRE_SHARED();
  const auto robots = shared() / "data/graspit/models/robots";
  const auto xml = shared() / "data/graspit-xml/models/robots";
  // the set of the human hand was measured with its XML model, whose file names another set
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"eigen_barrett", "Barrett/Barrett.cfg", ""},
      {"eigen_dlr", "DLR/DLR.cfg", ""},
      {"eigen_hh20", "HumanHand/HumanHand20DOF.cfg", "HumanHand/eigen/human_eigen_cgdb.xml"}};
  for (const auto& [name, file, set] : cases) {
    INFO(name);
    const auto measured = test::measured(name);
    ReadOptions options;
    if (*set) options.eigengrasps = (xml / set).string();
    World world;
    const auto hand = world.add_robot(read_robot(robots / file, options), {});
    const Eigengrasps grasps(world.robot(hand));
    REQUIRE(grasps.size() == measured["eigengrasps"].get<int>());
    for (int i = 0; i < grasps.size(); ++i) {
      const auto v = measured["basis"][i]["vector_normalised"].get<std::vector<double>>();
      for (int d = 0; d < grasps.dofs(); ++d)
        CHECK(std::abs(grasps.vectors()(i, d) - v[d]) < 1e-12);
    }
    REQUIRE(measured["postures"].size() == 24);
    for (const auto& posture : measured["postures"]) {
      const auto numbers = [&](const char* key) {
        const auto x = posture[key].get<std::vector<double>>();
        return VectorXd(Eigen::Map<const VectorXd>(x.data(), static_cast<int>(x.size())));
      };
      const VectorXd a = grasps.amplitudes(numbers("dof"));
      CHECK((a - numbers("amp")).cwiseAbs().maxCoeff() < 1e-9);
      CHECK((grasps.posture(a) - numbers("dof_back_rigid")).cwiseAbs().maxCoeff() < 1e-9);
    }
  }
}
