#include "clench/grasp/force/equilibrium.h"

#include "clench/base/error.h"
#include "grasp/jaws.h"

using namespace clench;
using Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd;
using test::Jaws, test::jaws, test::wrench;

namespace {

Equilibrium ask(const Jaws& j, const EquilibriumOptions& options) {
  return equilibrium(j.world, j.grasp, options);
}

}  // namespace

TEST_CASE("motors hold the forces that friction transmits, up to their limits") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 10);
  const Equilibrium held = ask(j, {.load = wrench(0, 0, -9.9, 0, 0, 0)});
  REQUIRE(held.status == EquilibriumStatus::stable);
  CHECK(held.result.residual < 1e-8);
  // each jaw presses with 9.9, which is its motor's effort
  CHECK((held.result.efforts - Vector2d(9.9, 9.9)).norm() < 1e-6);
  const Equilibrium falls = ask(j, {.load = wrench(0, 0, -10.1, 0, 0, 0)});
  REQUIRE(falls.status == EquilibriumStatus::unstable);
  CHECK((falls.result.unbalanced - wrench(0, 0, -0.1, 0, 0, 0)).norm() < 1e-6);
  REQUIRE(falls.result.certificate.has_value());
  CHECK(falls.result.certificate->dof >= 0);
  const auto& shares = falls.result.certificate->effort_limit_power;
  CHECK(shares[0] > 0);
  CHECK(shares[0] + shares[1] == doctest::Approx(falls.result.certificate->capacity));
  CHECK(falls.result.certificate->power > falls.result.certificate->capacity);
}

TEST_CASE("limits and torques can be given") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 0);  // motors without known limits
  const Vector6d load = wrench(0, 0, -5, 0, 0, 0);
  CHECK(ask(j, {.load = load}).status == EquilibriumStatus::stable);
  JointDemand weak;
  weak.limits = Vector2d(4, 4);
  CHECK(ask(j, {.load = load, .joints = weak}).status == EquilibriumStatus::unstable);
  weak.limits.reset();
  weak.unlimited = true;
  CHECK(ask(jaws(DofKind::rigid, 0.5, 1), {.load = load, .joints = weak}).status ==
        EquilibriumStatus::stable);
  JointDemand given;
  given.efforts = Vector2d(6, 6);
  const Equilibrium pressed = ask(j, {.load = load, .joints = given});
  REQUIRE(pressed.status == EquilibriumStatus::stable);
  CHECK(std::abs(pressed.result.forces[0].normal - 6) < 1e-7);
  // jaws with unequal forces push the block
  given.efforts = Vector2d(6, 7);
  const Equilibrium pushed = ask(j, {.load = load, .joints = given});
  REQUIRE(pushed.status == EquilibriumStatus::unstable);
  CHECK((pushed.result.unbalanced - wrench(1, 0, 0, 0, 0, 0)).norm() < 1e-6);
  // a pulling jaw moves away from the block
  given.efforts = Vector2d(-1, 6);
  CHECK(ask(j, {.load = load, .joints = given}).status == EquilibriumStatus::moving);
  // a cap of the contact forces applies in addition to the motors
  CHECK(ask(j, {.load = load, .joints = {}, .max_force = 4.0}).status ==
        EquilibriumStatus::unstable);
}

TEST_CASE("a palm carries a load without any motor") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 1, true);
  const Equilibrium held = ask(j, {.load = wrench(0, 0, -50, 0, 0, 0)});
  REQUIRE(held.status == EquilibriumStatus::stable);
  CHECK(std::abs(held.result.forces[2].normal - 50) < 1e-6);
  CHECK(held.result.efforts.norm() < 1e-6);
}

TEST_CASE("springs alone hold loads up to their own force") {
  const Jaws j = jaws(DofKind::compliant, 0.5, 100, false, 100);  // 3 N at q = 0.07
  JointDemand springs;
  springs.springs_only = true;
  const auto at = [&](double weight, const JointDemand& demand) {
    return ask(j, {.load = wrench(0, 0, -weight, 0, 0, 0), .joints = demand});
  };
  const Equilibrium held = at(2.9, springs);
  REQUIRE(held.status == EquilibriumStatus::stable);
  for (const ContactForce& f : held.result.forces) CHECK(std::abs(f.normal - 3) < 1e-7);
  CHECK(at(3.1, springs).status == EquilibriumStatus::unstable);
  const Equilibrium helped = at(5, {});
  REQUIRE(helped.status == EquilibriumStatus::stable);
  CHECK((helped.result.efforts - Vector2d(2, 2)).norm() < 1e-6);
}

TEST_CASE("forces for a given sum of torques") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 0);
  ForceOptions options{.load = wrench(0, 0, -2, 0, 0, 0),
                       .objective = ForceObjective::max_margin_sum};
  options.joints.emplace();
  options.joints->total_torque = 12;
  options.joints->unilateral = true;
  const ForceResult r = contact_forces(j.world, j.grasp, options);
  REQUIRE(r.status == ForceStatus::optimal);
  CHECK((r.efforts - Vector2d(6, 6)).norm() < 1e-6);
  CHECK(std::abs(r.objective - 2 * (0.5 * 6 - 1) / std::sqrt(1.25)) < 1e-6);
}

TEST_CASE("invalid torques are rejected") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 1);
  JointDemand demand;
  demand.limits = Vector2d(-1, 1);
  CHECK_THROWS_WITH_AS(ask(j, {.joints = demand}),
                       "contact forces: torque limits: expected numbers >= 0 [N m or N], got -1",
                       Error);
  demand.limits.reset();
  demand.efforts = Vector2d(std::numeric_limits<double>::quiet_NaN(), 1);
  CHECK_THROWS_WITH_AS(ask(j, {.joints = demand}),
                       "contact forces: torques: expected finite numbers [N m or N], got nan",
                       Error);
  demand.efforts = VectorXd::Ones(3);
  CHECK_THROWS_WITH_AS(ask(j, {.joints = demand}),
                       "contact forces: torques: expected 2, one per DOF, got 3", Error);
}
