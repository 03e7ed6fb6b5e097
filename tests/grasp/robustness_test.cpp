#include "clench/grasp/measure/robustness.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/contact/cone.h"

using namespace clench;
using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

namespace {

// contacts at the given points that press towards the origin
RobustnessProblem towards_origin(const std::vector<Vector3d>& points, double mu) {
  const auto n = static_cast<Eigen::Index>(points.size());
  RobustnessProblem problem;
  problem.G.resize(6, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Matrix3d frame = contact_frame(-points[i].normalized());
    for (int k = 0; k < 3; ++k) {
      const Vector3d axis = frame.col((k + 2) % 3);  // the normal first
      problem.G.col(3 * i + k) << axis, points[i].cross(axis);
    }
    problem.starts.push_back(static_cast<int>(3 * i));
  }
  problem.starts.push_back(static_cast<int>(3 * n));
  problem.J = MatrixXd::Identity(3 * n, 3 * n);
  problem.mu = VectorXd::Constant(n, mu);
  problem.compliance = VectorXd::Ones(3 * n);
  return problem;
}

RobustnessProblem at_random(Random& random, int contacts) {
  std::vector<Vector3d> points;
  for (int i = 0; i < contacts; ++i) {
    Vector3d p(random.normal(), random.normal(), random.normal());
    points.push_back(p.normalized() * random.uniform(0.5, 1));
  }
  RobustnessProblem problem = towards_origin(points, random.uniform(0.3, 1));
  problem.J = MatrixXd::Random(3 * contacts, 4);
  for (double& x : problem.J.reshaped()) x = random.normal();
  for (double& c : problem.compliance) c = random.uniform(0.5, 2);
  for (double& x : problem.load) x = 0.1 * random.normal();
  return problem;
}

// largest violation of a contact force's bounds
double excess(const RobustnessProblem& p, const VectorXd& f,
              const std::vector<ContactHold>& states) {
  double worst = -1e300;
  for (Eigen::Index i = 0; i < p.mu.size(); ++i) {
    if (states[i] == ContactHold::detached) continue;
    const double normal = f[3 * i];
    worst = std::max({worst, -normal, normal - p.max_force});
    if (states[i] == ContactHold::sticks)
      worst = std::max(worst, f.segment(3 * i + 1, 2).norm() - p.mu[i] * normal);
  }
  return worst;
}

template <class Act>
void each_state(int contacts, Act act) {
  int all = 1;
  for (int i = 0; i < contacts; ++i) all *= 3;
  for (int code = 0; code < all; ++code) {
    std::vector<ContactHold> states;
    for (int i = 0, rest = code; i < contacts; ++i, rest /= 3)
      states.push_back(static_cast<ContactHold>(rest % 3));
    act(states);
  }
}

}  // namespace

TEST_CASE("the robustness of six fingers on the faces of a cube equals the formula") {
  const std::vector<Vector3d> faces = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                       {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  for (const double mu : {0.2, 0.5, 1.0}) {
    const RobustnessProblem problem = towards_origin(faces, mu);
    // the force midway between cone and cap: sin(atan mu) f = cap - f, and the least stretch of G
    // is 2
    const double slope = mu / std::sqrt(1 + mu * mu), margin = 10 * slope / (1 + slope);
    const Robustness found = contact_robustness(problem);
    CHECK(found.margin == doctest::Approx(margin).epsilon(1e-7));
    CHECK(found.radius == doctest::Approx(2 * margin).epsilon(1e-7));
  }
}

TEST_CASE("disturbances within the radius leave every contact force inside its bounds") {
  Random random(5);
  int robust = 0;
  for (int round = 0; round < 200; ++round) {
    const RobustnessProblem problem = at_random(random, 5);
    const Robustness found = contact_robustness(problem);
    if (found.radius == 0) continue;
    ++robust;
    CHECK((problem.G * found.forces + problem.load).norm() < 1e-9);
    CHECK(excess(problem, found.forces, found.states) < 0);
    // the springs share a disturbance by the weighted right inverse
    const MatrixXd K = problem.compliance.cwiseInverse().asDiagonal();
    const MatrixXd GK = problem.G * K;
    const MatrixXd right = K * problem.G.transpose() * (GK * problem.G.transpose()).inverse();
    for (int i = 0; i < 50; ++i) {
      Vector6d w;
      for (double& x : w) x = random.normal();
      w *= found.radius / w.norm();
      CHECK(excess(problem, found.forces - right * w, found.states) < 1e-8);
    }
  }
  CHECK(robust > 5);
}

TEST_CASE("the search over states finds the same maximum as the enumeration of all states") {
  Random random(6);
  for (int round = 0; round < 12; ++round) {
    const int contacts = 3 + round % 2;
    const RobustnessProblem problem = at_random(random, contacts);
    double best = 0;
    each_state(contacts, [&](const std::vector<ContactHold>& states) {
      best = std::max(best, contact_robustness(problem, states).radius);
    });
    const Robustness found = grasp_robustness(problem);
    // two programs solved to 1e-9 each
    CHECK(found.radius == doctest::Approx(best).epsilon(1e-7));
    CHECK(found.most == doctest::Approx(found.radius).epsilon(1e-7));
  }
}

TEST_CASE("a search with a limit reports a valid upper bound") {
  Random random(9);
  for (int round = 0; round < 4; ++round) {
    const RobustnessProblem problem = at_random(random, 5);
    const double best = grasp_robustness(problem).radius;
    for (const int steps : {0, 1, 10, 40}) {
      const Robustness found = grasp_robustness(problem, steps);
      CHECK(found.radius <= best * (1 + 1e-7));
      CHECK(found.most >= best * (1 - 1e-7));
    }
  }
  // it ends within the limit for any number of contacts
  const Robustness many = grasp_robustness(at_random(random, 25), 60);
  CHECK(many.most >= many.radius);
}

TEST_CASE("another unit of force and another order of contacts change nothing else") {
  Random random(7);
  RobustnessProblem problem = at_random(random, 5);
  while (contact_robustness(problem).radius == 0) problem = at_random(random, 5);
  const double radius = contact_robustness(problem).radius;

  RobustnessProblem larger = problem;
  larger.load *= 1000, larger.max_force *= 1000;
  CHECK(contact_robustness(larger).radius == doctest::Approx(1000 * radius).epsilon(1e-7));

  RobustnessProblem turned = problem;
  for (int i = 0; i < 5; ++i) {
    const int from = 3 * ((i + 2) % 5);
    turned.G.middleCols(3 * i, 3) = problem.G.middleCols(from, 3);
    turned.J.middleRows(3 * i, 3) = problem.J.middleRows(from, 3);
    turned.compliance.segment(3 * i, 3) = problem.compliance.segment(from, 3);
  }
  CHECK(contact_robustness(turned).radius == doctest::Approx(radius).epsilon(1e-7));
}

// from 1e-12 to 1e13
template <class Visit>
static void each_size(Visit visit) {
  for (int e = -12; e <= 13; ++e) {
    CAPTURE(e);
    visit(std::pow(10.0, e));
  }
}

TEST_CASE("friction, torque lengths and caps of any size agree with the formula for six fingers") {
  const std::vector<Vector3d> faces = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                       {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  const auto check = [](const RobustnessProblem& problem, double radius) {
    CHECK(std::abs(contact_robustness(problem).radius - radius) <= 1e-7 * radius);
    const Robustness best = grasp_robustness(problem, 20);
    CHECK(best.radius >= radius * (1 - 1e-7));
    CHECK(best.most >= best.radius);
  };
  const auto margin = [](double mu) { return 10 * mu / (mu + std::sqrt(1 + mu * mu)); };
  each_size([&](double x) {
    // the margin is that of forces, whose least stretch is 2 or, for short torque lengths, the root
    // of 6
    RobustnessProblem problem = towards_origin(faces, 0.5);
    problem.G.bottomRows<3>() *= x;
    check(problem, margin(0.5) * std::min(2 * x, std::sqrt(6.0)));
    if (x <= 1e6 && x >= 1e-6) check(towards_origin(faces, x), 2 * margin(x));
    problem = towards_origin(faces, 0.5);
    problem.max_force = x;
    check(problem, 2 * margin(0.5) * x / 10);
    // forces between cone and cap: for a negligible load, and for a load that is too large
    problem.load[2] = -1;
    const double found = contact_robustness(problem).radius, free = 2 * margin(0.5) * x / 10;
    CHECK(found <= free * (1 + 1e-7));
    if (x > 10) CHECK(found > free * (1 - 1e-7) - 2);
    if (x < 0.1) CHECK(grasp_robustness(problem, 20).radius == 0);
  });
}

TEST_CASE("the unit of one DOF, of compliance or of all forces changes nothing else") {
  Random random(7);
  RobustnessProblem problem = at_random(random, 5);
  while (contact_robustness(problem).radius == 0) problem = at_random(random, 5);
  const double radius = contact_robustness(problem).radius;
  each_size([&](double x) {
    const auto check = [&](auto change, double times) {
      RobustnessProblem other = problem;
      change(other);
      const double expected = times * radius;
      CHECK(std::abs(contact_robustness(other).radius - expected) <= 1e-6 * expected);
    };
    check([&](RobustnessProblem& p) { p.J.col(1) *= x; }, 1);
    check([&](RobustnessProblem& p) { p.J *= x; }, 1);
    check([&](RobustnessProblem& p) { p.compliance *= x; }, 1);
    check([&](RobustnessProblem& p) { p.load *= x, p.max_force *= x; }, x);
  });
}

TEST_CASE("two fingers, or a load beyond the caps, are not robust") {
  CHECK(contact_robustness(towards_origin({{1, 0, 0}, {-1, 0, 0}}, 1)).radius == 0);
  CHECK(grasp_robustness(towards_origin({{1, 0, 0}, {-1, 0, 0}}, 1)).radius == 0);
  CHECK(grasp_robustness(towards_origin({}, 1)).radius == 0);
  RobustnessProblem heavy =
      towards_origin({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 0.5);
  heavy.load[2] = -1000;
  CHECK(contact_robustness(heavy).radius == 0);
  CHECK(grasp_robustness(heavy).radius == 0);
}

TEST_CASE("arguments out of range are rejected by name") {
  const auto refused = [](auto change, const char* sentence) {
    RobustnessProblem problem = towards_origin({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}, 0.5);
    change(problem);
    CHECK_THROWS_WITH_AS(contact_robustness(problem), sentence, Error);
  };
  refused([](RobustnessProblem& p) { p.mu[1] = -1; },
          "robustness: mu: expected a number from 0 to 1e+06, got -1");
  refused([](RobustnessProblem& p) { p.compliance[2] = 0; },
          "robustness: compliance must be > 0, got 0 [m/N]");
  refused([](RobustnessProblem& p) { p.max_force = 0; },
          "robustness: max_force must be > 0, got 0 [N]");
  refused([](RobustnessProblem& p) { p.load[3] = NAN; },
          "robustness: G, J and the load must be finite");
  refused(
      [](RobustnessProblem& p) { p.G.resize(6, 6); },
      "robustness: expected G of 6 x 9, J of 9 rows and as many compliances, got 6 x 6, 9 and 9");
  refused(
      [](RobustnessProblem& p) {
        p.starts = {0, 3, 9};
      },
      "robustness of 3 contacts: expected the starts of their forces and the end, rising from 0, "
      "got 0, 3, 9");
  CHECK_THROWS_WITH_AS(contact_robustness(towards_origin({{1, 0, 0}}, 1), {}),
                       "robustness: expected 1 states, one per contact, got 0", Error);
}
