// All parameters of contact forces, over 25 orders of magnitude: results called optimal, infeasible
// or stable are checked by plain sums and closed formulas, and between 1e-6 and 1e6 every query
// must have an answer.
#include "clench/base/error.h"
#include "clench/grasp/force/equilibrium.h"
#include "clench/grasp/force/resistance.h"
#include "clench/grasp/measure/measures.h"
#include "grasp/jaws.h"

using namespace clench;
using Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd;
using test::held, test::Held, test::jaws, test::Jaws, test::wrench;

namespace {

// the guarantee is 1e-9 of the largest numbers, here summed over some contacts and in other units
constexpr double relative_error = 1e-7;

constexpr ForceObjective all_objectives[] = {ForceObjective::min_sum, ForceObjective::min_norm,
                                             ForceObjective::min_max, ForceObjective::max_margin,
                                             ForceObjective::max_margin_sum};

const Vector6d some_load = wrench(0.3, -0.5, -0.8, 0.01, 0.02, -0.03);

// from 1e-12 to 1e13; must: an answer is required
template <class Visit>
void each_power(Visit visit) {
  for (int e = -12; e <= 13; ++e) {
    CAPTURE(e);
    visit(std::pow(10.0, e), std::abs(e) <= 6);
  }
}

using Sum = Eigen::Matrix<long double, 3, 1>;

// Balance, cones and caps by sums with higher precision than the solver's. The unbalanced rest is
// compared with the load and, as a torque, with the load at the longest arm.
void check_sums(const Held& h, const ForceOptions& options, const ForceResult& r) {
  Sum force = options.load.head<3>().cast<long double>(),
      torque = options.load.tail<3>().cast<long double>();
  double largest = 0, arm = 0, total = 0;
  for (size_t i = 0; i < r.forces.size(); ++i) {
    const PointContact& c = h.grasp.points[i];
    const ForceOptions& o = options;
    const ContactForce& f = r.forces[i];
    const Sum f_W = f.force_W.cast<long double>();
    const Sum p = (c.p_O - h.grasp.com).cast<long double>();
    force += f_W;
    torque += p.cross(f_W) + c.n_O.cast<long double>() * static_cast<long double>(f.torsion);
    largest = std::max(largest, f.force_W.norm());
    arm = std::max(arm, static_cast<double>(p.norm()));
    total += f.normal;
    if (o.max_force) CHECK(f.normal <= o.max_force.of(static_cast<int>(i)) * (1 + relative_error));
  }
  const double of_load = options.load.head<3>().norm() * arm + options.load.tail<3>().norm();
  for (size_t i = 0; i < r.forces.size(); ++i) {
    const PointContact& c = h.grasp.points[i];
    const ContactForce& f = r.forces[i];
    const double twist = c.torsion_radius > 0 ? f.torsion / c.torsion_radius : 0;
    // forces that are tiny compared with the load have its rounding error
    const double off = relative_error * largest + 1e-15 * of_load / arm;
    CHECK(std::hypot(f.tangential.norm(), twist) <= c.mu * f.normal + std::max(1.0, c.mu) * off);
    CHECK(f.normal >= -off);
  }
  // and the rounding of the forces by rotation
  const double allowed =
      (of_load > 0 ? 3e-7 * of_load : 1e-9 * largest * arm) + 1e-15 * largest * arm;
  CHECK(static_cast<double>(force.norm()) * arm <= allowed);
  CHECK(static_cast<double>(torque.norm()) <= allowed);
  if (options.max_total_force) CHECK(total <= *options.max_total_force * (1 + relative_error));
  if (options.total_force) CHECK(std::abs(total - *options.total_force) <= relative_error * total);
}

ForceResult hold(const Held& h, const ForceOptions& options) {
  return contact_forces(h.world, h.grasp, options);
}

// an answer if required, checked by sums; best: expected objective; feasible: whether a solution
// exists
void check_hold(const Held& h, const ForceOptions& options, bool must, bool feasible,
                std::optional<double> best = {}) {
  const ForceResult r = hold(h, options);
  if (must) REQUIRE(r.status == (feasible ? ForceStatus::optimal : ForceStatus::infeasible));
  if (r.status == ForceStatus::optimal) {
    CHECK(feasible);
    check_sums(h, options, r);
    // the objective of forces that almost equal the friction limit has the accuracy of the load
    if (best)
      CHECK(std::abs(r.objective - *best) <= relative_error * *best + 1e-11 * options.load.norm());
  }
  if (r.status == ForceStatus::infeasible) CHECK(!feasible);
  CHECK(r.status != ForceStatus::unbounded);
}

Held held_ball(double mu = 0.6) { return held(test::around_ball(7, mu, 3)); }

// the largest load for caps of one newton
double largest_of_unit(const Held& h, ForceOptions options) {
  options.load = some_load;
  const ForceResult r = max_load(h.world, h.grasp, options);
  REQUIRE(r.status == ForceStatus::optimal);
  return r.load_factor;
}

}  // namespace

TEST_CASE("forces scale with load and caps") {
  const Held h = held_ball();
  for (const ForceObjective by : all_objectives) {
    CAPTURE(static_cast<int>(by));
    const double once = hold(h, {.load = some_load, .objective = by, .max_force = 10.0}).objective;
    each_power([&](double x, bool) {
      const double times = by == ForceObjective::min_norm ? x * x : x;
      check_hold(h, {.load = x * some_load, .objective = by, .max_force = 10 * x}, true, true,
                 once * times);
    });
  }
}

TEST_CASE("a load of any size with given caps or a given sum") {
  const Held h = held_ball();
  const double most = largest_of_unit(h, {.max_force = 1.0});
  for (const ForceObjective by : all_objectives) {
    CAPTURE(static_cast<int>(by));
    each_power([&](double x, bool must) {
      check_hold(h, {.load = x * some_load, .objective = by, .max_force = 10.0}, must,
                 x < 10 * most);
      check_hold(h, {.load = x * some_load, .objective = by, .total_force = 10.0}, must, x < 5);
    });
  }
}

TEST_CASE("an inactive cap changes nothing") {
  const Held h = held_ball();
  const double most = largest_of_unit(h, {.max_force = 1.0}),
               max_total = largest_of_unit(h, {.max_total_force = 1.0});
  for (const ForceObjective by :
       {ForceObjective::min_sum, ForceObjective::min_norm, ForceObjective::min_max}) {
    CAPTURE(static_cast<int>(by));
    const ForceResult free = hold(h, {.load = some_load, .objective = by});
    double peak = 0, total = 0;
    for (const ContactForce& f : free.forces) peak = std::max(peak, f.normal), total += f.normal;
    each_power([&](double x, bool) {
      const auto best = [&](double needed) {
        return x > needed ? std::optional(free.objective) : std::nullopt;
      };
      check_hold(h, {.load = some_load, .objective = by, .max_force = x}, true, x * most > 1,
                 best(peak));
      check_hold(h, {.load = some_load, .objective = by, .max_total_force = x}, true,
                 x * max_total > 1, best(total));
      if (by != ForceObjective::min_norm || x < 10) return;
      // min_norm is the only objective with unique forces, to the square root of the accuracy of
      // the objective
      const ForceResult r = hold(h, {.load = some_load, .objective = by, .max_force = x});
      for (size_t i = 0; i < r.forces.size(); ++i)
        CHECK((r.forces[i].force_W - free.forces[i].force_W).norm() < 1e-5);
    });
  }
}

TEST_CASE("forces that are large compared with the load are solved or reported as inaccurate") {
  const Held h = held_ball();
  const double most = largest_of_unit(h, {.max_force = 1.0}),
               max_total = largest_of_unit(h, {.max_total_force = 1.0});
  for (const ForceObjective by : all_objectives)
    each_power([&](double x, bool must) {
      check_hold(h, {.load = some_load, .objective = by, .total_force = x}, must,
                 x * max_total > 1);
      if (by != ForceObjective::max_margin && by != ForceObjective::max_margin_sum) return;
      check_hold(h, {.load = some_load, .objective = by, .max_force = x}, must, x * most > 1);
    });
  const ForceResult absurd = hold(h, {.load = some_load, .total_force = 1e300});
  CHECK(absurd.status == ForceStatus::inaccurate);
}

TEST_CASE("friction and torsion radii of any size") {
  each_power([&](double x, bool must) {
    // each finger carries half of the load by friction
    const Held pinch = held(test::pinch(x));
    const Vector6d weight = wrench(0, 0, -1, 0, 0, 0);
    const auto check = [&](const Held& h, const Vector6d& load, ForceObjective by, double best) {
      check_hold(h, {.load = load, .objective = by}, must, true, best);
    };
    check(pinch, weight, ForceObjective::min_sum, 1 / x);
    check(pinch, weight, ForceObjective::min_max, 0.5 / x);
    check(pinch, weight, ForceObjective::min_norm, 0.5 / (x * x) + 0.5);
    // and half of a torque by torsion
    const Held soft = held(test::pinch(0.5, x));
    check(soft, wrench(0, 0, 0, 1, 0, 0), ForceObjective::min_sum, 2 / x);
    for (const ForceObjective by : all_objectives) {
      const Held h = held_ball(x);
      const ForceOptions options{.load = some_load, .objective = by, .max_force = 10.0};
      const ForceResult r = hold(h, options);
      if (r.status == ForceStatus::optimal) check_sums(h, options, r);
      if (must) CHECK(r.status != ForceStatus::inaccurate);
      // a grasp held with less friction is also held with more
      CHECK((r.status != ForceStatus::infeasible || x < 0.1));
      CHECK((r.status != ForceStatus::optimal || x > 1e-3));
    }
  });
}

TEST_CASE(
    "neither the length scale of torques nor the size of the object changes the forces for a "
    "load") {
  const Held h = held_ball();
  for (const ForceObjective by : all_objectives) {
    const ForceOptions options{.load = some_load, .objective = by, .max_force = 10.0};
    const double once = hold(h, options).objective;
    each_power([&](double x, bool) {
      Held other = held_ball();
      other.grasp.rho = x;
      check_hold(other, options, true, true, once);
      auto points = h.grasp.points;
      for (PointContact& point : points) point.p_O *= x;
      Held scaled = held(points);
      scaled.grasp.rho = 0.1 * x;
      ForceOptions longer = options;
      longer.load.tail<3>() *= x;
      check_hold(scaled, longer, true, true, once);
    });
  }
  // without friction nothing resists the transverse force, for any length scale of torques
  each_power([&](double x, bool must) {
    Held smooth = held(test::pinch(0));
    smooth.grasp.rho = x;
    const ForceResult r = hold(smooth, {.load = wrench(1, 2, 0, 0, 0.03, 0), .nearest = true});
    if (must) REQUIRE(r.status == ForceStatus::optimal);
    if (r.status != ForceStatus::optimal) return;
    CHECK(r.residual == doctest::Approx(std::hypot(2, 0.03 / x)).epsilon(relative_error));
  });
}

TEST_CASE("the largest load scales with caps and friction, and so does resistance") {
  const Vector6d weight = wrench(0, 0, -1, 0, 0, 0);
  const auto check = [&](const Held& h, double cap, double expected, bool must) {
    const ForceResult r = max_load(h.world, h.grasp, {.load = weight, .max_force = cap});
    if (must) REQUIRE(r.status == ForceStatus::optimal);
    if (r.status == ForceStatus::optimal)
      CHECK(std::abs(r.load_factor - expected) <= relative_error * expected + 1e-15 * cap);
    CHECK(r.status != ForceStatus::infeasible);
  };
  each_power([&](double x, bool must) {
    check(held(test::pinch(0.5)), x, x, must);
    check(held(test::pinch(x)), 1, 2 * x, must);
    const Held turned = held(test::pinch(0.5));
    if (must)
      CHECK(resistance(turned.world, turned.grasp, x * weight) ==
            doctest::Approx(0.5 / x).epsilon(relative_error));
    Held other = turned;
    other.grasp.rho = x;
    CHECK(resistance(other.world, other.grasp, weight) ==
          doctest::Approx(0.5).epsilon(relative_error));
  });
}

TEST_CASE("equilibrium is stable according to motors, springs and caps of any size") {
  const auto ask = [](const Jaws& j, const EquilibriumOptions& options, bool must, bool stable) {
    const Equilibrium e = equilibrium(j.world, j.grasp, options);
    if (must)
      REQUIRE(e.status == (stable ? EquilibriumStatus::stable : EquilibriumStatus::unstable));
    if (e.status == EquilibriumStatus::unstable) CHECK(!stable);
    CHECK(e.status != EquilibriumStatus::moving);
    if (e.status != EquilibriumStatus::stable) return;
    CHECK(stable);
    // plain sums, along the axes of the world and of the object, which agree
    Sum sum = options.load.head<3>().cast<long double>();
    for (const ContactForce& f : e.result.forces) sum += f.force_W.cast<long double>();
    CHECK(static_cast<double>(sum.norm()) <= 2e-7 * options.load.norm());
  };
  const Vector6d load = wrench(0, 0, -2, 0, 0, 0);  // each jaw presses with 2
  each_power([&](double x, bool must) {
    const Jaws free = jaws(DofKind::rigid, 0.5, 0), strong = jaws(DofKind::rigid, 0.5, x);
    ask(free, {.load = x * load}, true, true);
    ask(strong, {.load = load}, true, x > 2);
    ask(free, {.load = load, .max_force = x}, true, x > 2);
    JointDemand demand;
    demand.limits = Vector2d(x, x);
    ask(free, {.load = load, .joints = demand}, true, x > 2);
    demand.limits.reset();
    demand.efforts = Vector2d(x, x);
    ask(free, {.load = load, .joints = demand}, must, x > 2);
    ask(jaws(DofKind::rigid, x, 0), {.load = load}, must, true);
    // motors without limits compensate excess or missing forces of springs
    ask(jaws(DofKind::compliant, 0.5, 0, false, x), {.load = load}, must, true);
  });
}

// jaws of this mass above and below the block: the weight of the upper one reduces the effort of
// its motor
static Jaws upright_jaws(double mass, double max_effort) {
  Jaws j = jaws(DofKind::rigid, 0.5, max_effort);
  const Pose up = Pose::turn(-std::numbers::pi / 2, Vector3d::UnitY());  // x to z
  j.world.set_pose(j.grasp.hand, up);
  j.world.set_pose(j.grasp.object, up * j.world.pose(j.grasp.object));
  for (Contact& contact : j.grasp.contacts) {
    contact.p_W = up * contact.p_W;
    contact.n_W = up.rotation * contact.n_W;
  }
  for (const int c : {0, 1})
    j.world.set_mass(test::link_of(j.world.robot(j.grasp.hand), c, 0), mass);
  return j;
}

TEST_CASE("motors hold links of any mass and press with the remaining effort") {
  JointDemand demand;
  demand.link_weights = true;
  each_power([&](double mass, bool) {
    if (mass > 1e12) return;
    const double weight = 9.81 * mass;
    const auto ask = [&](double max_effort, EquilibriumStatus expected) {
      const Jaws j = upright_jaws(mass, max_effort);
      const Equilibrium e =
          equilibrium(j.world, j.grasp, {.load = wrench(0, 2, 0, 0, 0, 0), .joints = demand});
      REQUIRE(e.status == expected);
      if (expected != EquilibriumStatus::stable) return;
      for (int k = 0; k < 2; ++k) {
        const double normal = e.result.forces[k].normal, effort = e.result.efforts[k];
        CHECK(normal >= 2 - relative_error);
        const double off = relative_error * normal + 1e-14 * weight;
        CHECK(std::abs(effort - normal - (k == 0 ? -weight : weight)) <= off);
        if (max_effort > 0) CHECK(std::abs(effort) <= max_effort + off);
      }
    };
    // each jaw presses with 2 N, the lower one in addition to its weight; with less effort it
    // cannot even carry that
    const double needed = weight + 2;
    ask(0, EquilibriumStatus::stable);  // without limit
    ask(needed * (1 + 1e-4), EquilibriumStatus::stable);
    ask(needed * (1 - 1e-4),
        needed * (1 - 1e-4) > weight ? EquilibriumStatus::unstable : EquilibriumStatus::moving);
  });
}

TEST_CASE(
    "the effort for an object of any mass follows its weight, and robustness the remaining force") {
  const double free = 20 * 0.5 / (0.5 + std::sqrt(1.25));  // of six fingers with caps of 10 N
  std::vector<PointContact> faces;
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0})
      faces.push_back(
          test::contact_at(0.1 * side * Vector3d::Unit(k), -side * Vector3d::Unit(k), 0.5));
  each_power([&](double mass, bool) {
    if (mass > 1e12) return;
    const double weight = 9.81 * mass;
    Held pinched = held(test::pinch(0.5)), firm = held(faces);
    pinched.world.set_mass(pinched.grasp.object, mass);
    MeasuredGrasp measured(pinched.world, pinched.grasp);
    CHECK(find_measure("gravity_effort").of(measured) / (2 * weight) ==
          doctest::Approx(1).epsilon(relative_error));
    firm.world.set_mass(firm.grasp.object, mass);
    RobustnessProblem problem = MeasuredGrasp(firm.world, firm.grasp).robustness_problem();
    problem.J.setIdentity(18, 18);  // independently controlled fingers
    const double found = contact_robustness(problem).radius;
    CHECK(found <= free * (1 + relative_error));
    CHECK(found >= free * (1 - relative_error) - 2 * weight);
    CHECK((found == 0) == (mass > 5));
  });
}

TEST_CASE(
    "slightly inside the friction angle is never infeasible, and slightly outside never optimal") {
  const double slope = 0.3;
  for (double off = 1e-3; off > 1e-11; off /= 10)
    for (const double sign : {1.0, -1.0}) {
      CAPTURE(sign * off);
      const double mu = std::tan(slope) * (1 + sign * off);
      Held h = held({test::contact_at({0.05, 0, 0}, {-std::cos(slope), 0, std::sin(slope)}, mu),
                     test::contact_at({-0.05, 0, 0}, {std::cos(slope), 0, std::sin(slope)}, mu)});
      const ForceResult r = hold(h, {.load = wrench(0, 0, 1, 0, 0, 0)});
      CHECK(r.status != (sign > 0 ? ForceStatus::infeasible : ForceStatus::optimal));
    }
}

TEST_CASE("a margin of 0 is reported, with and without force closure") {
  const ForceOptions firm{.objective = ForceObjective::max_margin, .max_force = 10.0};
  const ForceResult one = hold(held({test::contact_at({0.05, 0, 0}, {-1, 0, 0}, 0.5)}), firm);
  REQUIRE(one.status == ForceStatus::optimal);
  CHECK(one.margin == 0);
  CHECK(one.objective == 0);
  const ForceResult two = hold(held(test::pinch(0.5)), firm);
  REQUIRE(two.status == ForceStatus::optimal);
  CHECK(two.margin == doctest::Approx(two.objective).epsilon(1e-6));
  CHECK(two.margin > 3);
  // least forces lie on the edges of the cones
  const ForceResult least = hold(held(test::pinch(0.5)), {.load = wrench(0, 0, -1, 0, 0, 0)});
  CHECK(least.margin < 1e-8);
}
