// Loads that jaws hold with motors that pull in one direction, weakly, or not at all.
#include "clench/base/random.h"
#include "clench/grasp/force/equilibrium.h"
#include "clench/model/effort_range.h"
#include "grasp/jaws.h"

using namespace clench;
using test::Jaws, test::jaws, test::wrench;

namespace {

constexpr double jaw_q = 0.07;  // of both jaws [m]

Jaws driven(const ActuatorSpec& law, double mu) {
  std::vector<ActuatorSpec> both(2, law);
  for (int side = 0; side < 2; ++side) {
    both[side].joint = "jaw" + std::to_string(side);
    both[side].dof = side;
  }
  return jaws(DofKind::rigid, mu, 0, false, 0, both);
}

// the largest weight that the motors hold by friction; infinite if unbounded
double largest_weight(const Jaws& j, const JointDemand& demand = {}) {
  const ForceResult r =
      max_load(j.world, j.grasp, {.load = wrench(0, 0, -1, 0, 0, 0), .joints = demand});
  if (r.status == ForceStatus::unbounded) return std::numeric_limits<double>::infinity();
  return r.status == ForceStatus::optimal ? r.load_factor : 0;
}

ActuatorSpec motor(double gear, double low, double high) {
  ActuatorSpec out;
  out.kind = "motor", out.gear = gear;
  out.control_range = {{low, high}};
  return out;
}

ActuatorSpec servo(double kp) {
  ActuatorSpec out;
  out.kind = "position", out.gain = kp, out.bias = {0, -kp, 0};
  return out;
}

}  // namespace

TEST_CASE("jaws without a closing motor hold nothing") {
  ActuatorSpec no_gain;
  no_gain.kind = "general", no_gain.gain = 0;
  for (const ActuatorSpec& law :
       {motor(0, -1, 1), motor(-1, 0, 20), motor(1, -20, 0), no_gain, servo(0)}) {
    const Jaws j = driven(law, 0.5);
    CHECK(largest_weight(j) == 0);
    JointDemand any;
    any.unlimited = true;
    CHECK(largest_weight(j, any) == 0);
    CHECK_FALSE(can_close(j.world, j.grasp.hand, 0));
    CHECK(equilibrium(j.world, j.grasp, {.load = wrench(0, 0, -0.01, 0, 0, 0)}).status !=
          EquilibriumStatus::stable);
  }
}

TEST_CASE("a motor that closes with a millinewton holds as much by friction") {
  ActuatorSpec weak = servo(100);
  weak.force_range = {{-20, 0.001}};
  const Jaws j = driven(weak, 0.5);
  CHECK(can_close(j.world, j.grasp.hand, 0));
  CHECK(largest_weight(j) == doctest::Approx(2 * 0.5 * 0.001));
}

TEST_CASE("random jaws hold twice the friction force of their weaker motor") {
  Random random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const double mu = random.uniform(0.1, 1);
    ActuatorSpec law;
    const double c0 = random.uniform(-2, 1), c1 = random.uniform(c0, 2);
    const double kind = random.uniform();
    if (kind < 0.4) {
      law = motor(random.uniform(-2, 2), c0, c1);
    } else if (kind < 0.7) {
      law = servo(random.uniform(0, 200));
      law.gear = random.uniform(-2, 2);
      if (random.uniform() < 0.5) law.control_range = {{-0.1, 0.1}};
    } else {
      law.kind = "general", law.gain = random.uniform(-5, 5), law.gear = random.uniform(-2, 2);
      law.control_range = {{c0, c1}};
    }
    if (random.uniform() < 0.5) {
      const double f0 = random.uniform(-10, 0);
      law.force_range = {{f0, random.uniform(f0, 10)}};
    }
    // the control law at the ends of the range; a servo without a range is unbounded
    double least = 1e300, press = -1e300;
    const std::array<double, 2> controls = law.control_range.value_or(std::array{-1e9, 1e9});
    for (const double control : controls) {
      double force = law.gain * control + law.bias[0] + law.bias[1] * law.gear * jaw_q;
      if (law.force_range) force = std::clamp(force, (*law.force_range)[0], (*law.force_range)[1]);
      press = std::max(press, force * law.gear);
      least = std::min(least, force * law.gear);
    }
    const Jaws j = driven(law, mu);
    const double held = largest_weight(j);
    CAPTURE(trial);
    if (press <= 0)
      CHECK(held == 0);
    else if (press > 1e6)
      CHECK(std::isinf(held));
    else
      CHECK(held == doctest::Approx(2 * mu * press).epsilon(1e-6));
  }
}

TEST_CASE("an actuator that pulls one jaw inwards and the other outwards holds nothing") {
  ActuatorSpec motor;
  motor.kind = "motor", motor.tendon = "t", motor.dof = 0;
  motor.control_range = {{-20, 20}};
  for (const double second : {1.0, 0.5, -1.0}) {
    motor.pulls = {{"jaw0", 1}, {"jaw1", second}};
    const Jaws j = jaws(DofKind::rigid, 0.5, 0, false, 0, {motor});
    CHECK(can_close(j.world, j.grasp.hand, 0));
    CHECK(can_close(j.world, j.grasp.hand, 1));
    // both press with equal force, or not at all
    CHECK(largest_weight(j) == doctest::Approx(second == 1 ? 2 * 0.5 * 20 : 0));
    JointDemand any;
    any.unlimited = true;
    if (second < 1) CHECK(largest_weight(j, any) == doctest::Approx(0));
  }
  // a second motor compensates the difference up to its range
  motor.pulls = {{"jaw0", 1}, {"jaw1", -1}};
  ActuatorSpec own;
  own.kind = "motor", own.joint = "jaw1", own.dof = 1, own.control_range = {{0, 30}};
  CHECK(largest_weight(jaws(DofKind::rigid, 0.5, 0, false, 0, {motor, own})) ==
        doctest::Approx(2 * 0.5 * 15));
}

TEST_CASE(
    "an effort range of a joint bounds the pressing force of its motor, separately for each "
    "direction") {
  ActuatorSpec law = motor(1, -20, 20);
  for (const auto& [low, high] :
       std::array<std::array<double, 2>, 3>{{{-20, 0}, {-20, 0.001}, {0, 7}}}) {
    std::vector<ActuatorSpec> both(2, law);
    for (int side = 0; side < 2; ++side) {
      both[side].joint = "jaw" + std::to_string(side);
      both[side].dof = side;
    }
    const Jaws j = jaws(DofKind::rigid, 0.5, 0, false, 0, both, std::array{low, high});
    CHECK(largest_weight(j) == doctest::Approx(2 * 0.5 * high));
    CHECK(can_close(j.world, j.grasp.hand, 0) == (high > 0));
  }
}

TEST_CASE("a maximal effort of the world bounds only motors without a limit") {
  Jaws j = jaws(DofKind::rigid, 0.5, 0);
  CHECK(std::isinf(largest_weight(j)));
  CHECK(unlimited_dofs(j.world, j.grasp.hand) == std::vector{0, 1});
  const auto limit = [](Jaws& of, double effort) {
    DynamicSettings settings = of.world.dynamic_settings();
    settings.robots[of.grasp.hand].max_effort = effort;
    of.world.set_dynamic_settings(settings);
  };
  limit(j, 6);
  CHECK(largest_weight(j) == doctest::Approx(6));
  CHECK(unlimited_dofs(j.world, j.grasp.hand).empty());
  Jaws strong = jaws(DofKind::rigid, 0.5, 10);
  limit(strong, 6);
  CHECK(largest_weight(strong) == doctest::Approx(10));
  CHECK_THROWS_WITH(limit(strong, 0), doctest::Contains("largest effort: expected a number"));
}
