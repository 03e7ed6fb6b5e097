#include "clench/grasp/force/contact_forces.h"

#include <coin/ClpSimplex.hpp>

#include "clench/base/error.h"
#include "clench/geometry/mesh/hull.h"
#include "grasp/held_object.h"

using namespace clench;
using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;
using test::held, test::Held, test::wrench;

// for a solver that is accurate to 1e-9, with forces of some newtons
static constexpr double close_to = 1e-7;

static ForceResult hold(Held& h, const ForceOptions& options) {
  return contact_forces(h.world, h.grasp, options);
}

static double sum_of_normals(const ForceResult& r) {
  double sum = 0;
  for (const ContactForce& f : r.forces) sum += f.normal;
  return sum;
}

// checks balance, cones and caps of the forces
static void check_forces(const Held& h, const ForceOptions& options, const ForceResult& r) {
  REQUIRE(r.status == ForceStatus::optimal);
  REQUIRE(r.forces.size() == h.grasp.points.size());
  const Pose& X_WO = h.world.pose(h.grasp.object);
  Vector6d sum = options.load;
  double largest = options.load.norm();
  for (const ContactForce& f : r.forces) largest = std::max(largest, f.force_W.norm());
  for (size_t i = 0; i < r.forces.size(); ++i) {
    const PointContact& c = h.grasp.points[i];
    const ContactForce& f = r.forces[i];
    const Vector3d n_W = X_WO.rotation * c.n_O, arm = X_WO.rotation * (c.p_O - h.grasp.com);
    sum.head<3>() += f.force_W;
    sum.tail<3>() += arm.cross(f.force_W) + f.torsion * n_W;
    CHECK(std::abs(n_W.dot(f.force_W) - f.normal) < 1e-12 * largest);
    const Eigen::Matrix3d frame = contact_frame(n_W);
    CHECK((frame.leftCols<2>().transpose() * f.force_W - f.tangential).norm() < 1e-12 * largest);
    const double twist = c.torsion_radius > 0 ? f.torsion / c.torsion_radius : 0;
    const double across = std::hypot(f.tangential.norm(), twist);
    CHECK(across <= c.mu * f.normal + 1e-9 * largest);  // tolerance guaranteed by the solver
    CHECK(std::abs(f.margin - (c.mu > 0 ? (c.mu * f.normal - across) / std::hypot(1, c.mu)
                                        : f.normal)) < 1e-12 * largest);
    if (options.max_force)
      CHECK(f.normal <= options.max_force.of(static_cast<int>(i)) * (1 + 1e-9));
  }
  CHECK(sum.norm() <= 1e-9 * largest);
  CHECK((sum - r.unbalanced).norm() <= 1e-12 * largest);
}

// the certificate is a proof for all admissible forces: their power along the twist is below that
// of the load
static void check_certificate(const Held& h, const ForceOptions& options, const ForceResult& r) {
  REQUIRE(r.status == ForceStatus::infeasible);
  REQUIRE(r.certificate.has_value());
  const ForceCertificate& c = *r.certificate;
  CHECK(c.power > c.capacity);
  CHECK(std::abs(c.power - options.load.dot(c.twist)) < 1e-9 * options.load.norm());
  const Pose& X_WO = h.world.pose(h.grasp.object);
  double resisted = 0;
  for (size_t i = 0; i < h.grasp.points.size(); ++i) {
    const PointContact& point = h.grasp.points[i];
    const Vector3d arm = X_WO.rotation * (point.p_O - h.grasp.com);
    const Vector3d v = c.twist.head<3>() + c.twist.tail<3>().cross(arm);
    const Vector3d n = X_WO.rotation * point.n_O;
    const double along = v.dot(n), spin = c.twist.tail<3>().dot(n) * point.torsion_radius;
    // maximal power that a unit of normal force resists: full friction against the slip
    const double most = point.mu * std::hypot((v - along * n).norm(), spin) - along;
    const double cap = options.max_force ? options.max_force.of(static_cast<int>(i)) : 1e7;
    if (most > 0) resisted += most * cap;
  }
  CHECK(resisted < c.power);
}

TEST_CASE("two fingers carry a weight by friction only") {
  for (const double mu : {0.1, 0.5, 2.0}) {
    Held h = held(test::pinch(mu));
    const ForceOptions options{.load = wrench(0, 0, -3, 0, 0, 0)};
    const ForceResult r = hold(h, options);
    check_forces(h, options, r);
    for (const ContactForce& f : r.forces) {
      CHECK(std::abs(f.normal - 1.5 / mu) < close_to);
      CHECK((f.force_W - Vector3d(f.force_W.x(), 0, 1.5)).norm() < close_to);
    }
    CHECK(std::abs(r.objective - 3 / mu) < close_to);
  }
}

TEST_CASE("three fingers around an upright can share its weight equally") {
  std::vector<PointContact> points;
  for (int i = 0; i < 3; ++i) {
    const double a = i * 2 * std::numbers::pi / 3;
    const Vector3d out(std::cos(a), std::sin(a), 0);
    points.push_back(test::contact_at(0.04 * out, -out, 0.4));
  }
  Held h = held(points);
  const ForceOptions options{.load = wrench(0, 0, -6, 0, 0, 0)};
  const ForceResult r = hold(h, options);
  check_forces(h, options, r);
  CHECK(std::abs(sum_of_normals(r) - 6 / 0.4) < close_to);
  for (const ContactForce& f : r.forces) CHECK(std::abs(f.normal - 5) < close_to);
}

TEST_CASE("a ball between frictionless plates carries only loads along their common normal") {
  Held h = held(test::pinch(0));
  ForceOptions options{.load = wrench(2, 0, 0, 0, 0, 0)};
  const ForceResult r = hold(h, options);
  check_forces(h, options, r);
  CHECK(std::abs(r.forces[0].normal - 2) < close_to);
  CHECK(std::abs(r.forces[1].normal) < close_to);
  options.load = wrench(0, 1, 0, 0, 0, 0);
  const ForceResult slips = hold(h, options);
  check_certificate(h, options, slips);
  // it moves with the load, unobstructed by the plates
  CHECK((slips.certificate->twist.head<3>() - Vector3d::UnitY()).norm() < 1e-6);
}

TEST_CASE("a wedge slips out at the friction angle") {
  const double slope = 0.3;  // of both faces, to the line between the fingers
  const auto wedge = [&](double mu) {
    return held({test::contact_at({0.05, 0, 0}, {-std::cos(slope), 0, std::sin(slope)}, mu),
                 test::contact_at({-0.05, 0, 0}, {std::cos(slope), 0, std::sin(slope)}, mu)});
  };
  const ForceOptions options{.load = wrench(0, 0, 1, 0, 0, 0)};
  Held rough = wedge(std::tan(slope) * (1 + 1e-6));
  check_forces(rough, options, hold(rough, options));
  Held smooth = wedge(std::tan(slope) * (1 - 1e-6));
  const ForceResult slips = hold(smooth, options);
  CHECK(slips.status == ForceStatus::infeasible);
}

TEST_CASE("caps bound the load, and the certificate names the finger that yields") {
  Held h = held(test::pinch(0.5));
  ForceOptions options{.load = wrench(0, 0, -3.99, 0, 0, 0), .max_force = 4};
  check_forces(h, options, hold(h, options));
  options.load = wrench(0, 0, -4.01, 0, 0, 0);
  const ForceResult r = hold(h, options);
  check_certificate(h, options, r);
  CHECK(std::abs(r.certificate->twist[2] + 1) < 1e-6);
  CHECK(std::abs(r.certificate->capacity - 4) < 1e-6);
  CHECK(std::abs(r.certificate->force_limit_power[0] - 2) < 1e-6);
  CHECK(r.certificate->contact >= 0);
  CHECK(r.certificate->dof == -1);
  CHECK(std::abs(r.certificate->sliding_rates[0] - 1) < 1e-6);
}

TEST_CASE("each contact may have its own cap") {
  Held h = held(test::pinch(0.5));
  // both fingers press with equal force, so the weaker one bounds both
  const auto most = [&](std::vector<double> caps) {
    const ForceOptions options{.load = wrench(0, 0, -1, 0, 0, 0), .max_force = std::move(caps)};
    return max_load(h.world, h.grasp, options);
  };
  CHECK(most({4, 4}).load_factor == doctest::Approx(4));
  const ForceResult weak = most({4, 3});
  CHECK(weak.load_factor == doctest::Approx(3));
  REQUIRE(weak.certificate.has_value());
  CHECK(weak.certificate->contact == 1);
  CHECK(weak.certificate->force_limit_power[0] < 1e-6);
  CHECK_THROWS_WITH_AS(
      most({1, 2, 3}),
      "contact forces: max_force: expected one number or 2, one per contact, got 3", Error);
  CHECK_THROWS_WITH_AS(most({1, -2}), "contact forces: max_force must be > 0 [N], got -2", Error);
}

TEST_CASE("the length of a load direction does not matter") {
  Held h = held(test::pinch(0.5));
  for (const double size : {1e-200, 1e-12, 1e-9, 1e-6, 1.0, 1e6, 1e12, 1e200}) {
    CAPTURE(size);
    const ForceOptions options{.load = wrench(0, 0, -size, 0, 0, 0), .max_force = 4};
    const ForceResult r = max_load(h.world, h.grasp, options);
    REQUIRE(r.status == ForceStatus::optimal);
    CHECK(r.load_factor * size == doctest::Approx(4).epsilon(1e-9));
    if (size < 1e-12 || size > 1e12) continue;
    // the certificate is as tight for tiny loads and caps as for others
    const ForceOptions small{.load = wrench(0, 0, -5 * size, 0, 0, 0), .max_force = 4 * size};
    const ForceResult falls = contact_forces(h.world, h.grasp, small);
    REQUIRE(falls.status == ForceStatus::infeasible);
    REQUIRE(falls.certificate.has_value());
    CHECK(falls.certificate->power / falls.certificate->capacity ==
          doctest::Approx(1.25).epsilon(1e-6));
  }
}

TEST_CASE("a torque about the line of two fingers requires soft fingers") {
  const ForceOptions options{.load = wrench(0, 0, 0, 0.03, 0, 0)};
  Held hard = held(test::pinch(0.5));
  const ForceResult turns = hold(hard, options);
  check_certificate(hard, options, turns);
  CHECK(std::abs(turns.certificate->twist.head<3>().norm()) < 1e-6);
  Held soft = held(test::pinch(0.5, 0.004));
  const ForceResult r = hold(soft, options);
  check_forces(soft, options, r);
  // each takes half: mu f_n radius = 0.015
  CHECK(std::abs(sum_of_normals(r) - 2 * 0.015 / (0.5 * 0.004)) < 1e-6);
}

TEST_CASE("the largest load is bounded by caps and friction") {
  Held h = held(test::pinch(0.5));
  ForceOptions options{.load = wrench(0, 0, -2, 0, 0, 0), .max_force = 4};
  const ForceResult r = max_load(h.world, h.grasp, options);
  REQUIRE(r.status == ForceStatus::optimal);
  CHECK(std::abs(r.load_factor - 2) < close_to);
  CHECK(r.residual < 1e-8);
  REQUIRE(r.certificate.has_value());
  CHECK(std::abs(r.certificate->power - r.certificate->capacity) < 1e-6);
  // unbounded without a cap
  options.max_force = {};
  CHECK(max_load(h.world, h.grasp, options).status == ForceStatus::unbounded);
  // a load that no force resists
  options.load = wrench(0, 0, 0, 1, 0, 0);
  const ForceResult none = max_load(h.world, h.grasp, options);
  REQUIRE(none.status == ForceStatus::optimal);
  CHECK(none.load_factor < close_to);
}

TEST_CASE("the margin objective maximizes the distance from edges and caps") {
  Held h = held(test::pinch(0.5));
  ForceOptions options{
      .load = wrench(0, 0, -2, 0, 0, 0), .objective = ForceObjective::max_margin, .max_force = 10};
  const ForceResult r = hold(h, options);
  check_forces(h, options, r);
  // (0.5 n - 1) / sqrt(1.25) = 10 - n
  const double root = std::sqrt(1.25), n = (10 * root + 1) / (0.5 + root);
  for (const ContactForce& f : r.forces) CHECK(std::abs(f.normal - n) < 1e-6);
  CHECK(std::abs(r.objective - (10 - n)) < 1e-6);
  options.objective = ForceObjective::max_margin_sum;
  const ForceResult sum = hold(h, options);
  check_forces(h, options, sum);
  CHECK(std::abs(sum.objective - 2 * (0.5 * 10 - 1) / root) < 1e-6);
  options.max_force = {};
  CHECK(hold(h, options).status == ForceStatus::unbounded);
  options.total_force = 12;
  const ForceResult fixed = hold(h, options);
  check_forces(h, options, fixed);
  CHECK(std::abs(sum_of_normals(fixed) - 12) < close_to);
}

TEST_CASE("the forces of each objective minimize that objective") {
  Held h = held(test::around_ball(7, 0.6, 3));
  const Vector6d load = wrench(1, -2, 0.5, 0.01, 0.02, -0.03);
  const auto measure = [](const ForceResult& r, ForceObjective by) {
    double sum = 0, squares = 0, peak = 0;
    for (const ContactForce& f : r.forces) {
      sum += f.normal;
      squares += f.force_W.squaredNorm();
      peak = std::max(peak, f.normal);
    }
    return by == ForceObjective::min_sum ? sum : by == ForceObjective::min_norm ? squares : peak;
  };
  const ForceObjective all[] = {ForceObjective::min_sum, ForceObjective::min_norm,
                                ForceObjective::min_max};
  for (const ForceObjective by : all) {
    const ForceOptions options{.load = load, .objective = by};
    const ForceResult best = hold(h, options);
    check_forces(h, options, best);
    CHECK(std::abs(best.objective - measure(best, by)) < close_to);
    for (const ForceObjective other : all)
      CHECK(measure(best, by) <
            measure(hold(h, {.load = load, .objective = other}), by) + close_to);
  }
}

// the least sum of normal forces with pyramids of `edges` edges, inside the cones or (grown) around
// them
static double by_pyramids(const Held& h, const Vector6d& load, int edges, double grown,
                          double cap) {
  ClpSimplex clp;
  clp.setLogLevel(0);
  clp.scaling(0);  // its scaling fails for 1e-18, which rounding leaves in place of 0
  const int contacts = static_cast<int>(h.grasp.points.size());
  clp.resize(0, contacts * edges);
  MatrixXd all(6, contacts * edges);
  for (int i = 0; i < contacts; ++i) {
    PointContact point = h.grasp.points[i];
    point.mu *= grown;
    all.middleCols(i * edges, edges) =
        cone_wrenches(point, {.edges = edges, .rho = 1, .p_OM = h.grasp.com});
  }
  std::vector<int> columns(contacts * edges), own(edges);
  for (int k = 0; k < contacts * edges; ++k) {
    columns[k] = k;
    clp.setColumnBounds(k, 0, COIN_DBL_MAX);
    clp.setObjectiveCoefficient(k, 1);
  }
  for (int d = 0; d < 6; ++d) {
    const VectorXd row = all.row(d);
    clp.addRow(contacts * edges, columns.data(), row.data(), -load[d], -load[d]);
  }
  const std::vector<double> ones(edges, 1.0);
  for (int i = 0; i < contacts; ++i) {
    for (int k = 0; k < edges; ++k) own[k] = i * edges + k;
    clp.addRow(edges, own.data(), ones.data(), -COIN_DBL_MAX, cap);
  }
  clp.setPrimalTolerance(1e-9);
  clp.primal();
  return clp.isProvenOptimal() ? clp.objectiveValue() : -1;
}

TEST_CASE("the round cone is bracketed by inner and outer pyramids, solved by the simplex method") {
  Random random(5);
  int decided = 0;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    Held h = held(test::around_ball(3 + i % 10, random.uniform(0.2, 1), 100 + i));
    Vector6d load;
    for (double& x : load) x = random.normal();
    load.tail<3>() *= 0.03;
    const double cap = i % 2 == 0 ? 3 : 1000;
    const int edges = 64;
    const double above = by_pyramids(h, load, edges, 1, cap);
    const double below = by_pyramids(h, load, edges, 1 / std::cos(std::numbers::pi / edges), cap);
    const ForceOptions options{.load = load, .max_force = cap};
    const ForceResult r = hold(h, options);
    if (r.status == ForceStatus::infeasible) {
      CHECK(above == -1);
      if (below == -1) check_certificate(h, options, r);
      continue;
    }
    ++decided;
    check_forces(h, options, r);
    CHECK(below > 0);
    CHECK(r.objective > below - 1e-6);
    if (above > 0) CHECK(r.objective < above + 1e-6);
  }
  CHECK(decided > 15);
}

TEST_CASE("the largest load for a sum of normal forces equals the ray of the wrench space") {
  Held h = held(test::around_ball(6, 0.7, 8));
  const int edges = 64;
  MatrixXd wrenches(6, 6 * edges);
  for (int i = 0; i < 6; ++i)
    wrenches.middleCols(i * edges, edges) =
        cone_wrenches(h.grasp.points[i], {.edges = edges, .rho = h.grasp.rho, .p_OM = h.grasp.com});
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    Vector6d direction;
    for (double& x : direction) x = random.normal();
    ForceOptions options{.load = direction, .max_total_force = 1};
    const ForceResult r = max_load(h.world, h.grasp, options);
    REQUIRE(r.status == ForceStatus::optimal);
    // the same with pyramids, by the simplex method: maximize t with sum of edges = -t direction
    ClpSimplex clp;
    clp.setLogLevel(0);
    clp.scaling(0);
    clp.resize(0, 6 * edges + 1);
    std::vector<int> columns(6 * edges + 1);
    for (int k = 0; k <= 6 * edges; ++k) {
      columns[k] = k;
      clp.setColumnBounds(k, 0, COIN_DBL_MAX);
      clp.setObjectiveCoefficient(k, k == 6 * edges ? -1 : 0);
    }
    for (int d = 0; d < 6; ++d) {
      VectorXd row(6 * edges + 1);
      row << wrenches.row(d).transpose() * (d < 3 ? 1 : h.grasp.rho), direction[d];
      clp.addRow(6 * edges + 1, columns.data(), row.data(), 0, 0);
    }
    const std::vector<double> ones(6 * edges, 1.0);
    clp.addRow(6 * edges, columns.data(), ones.data(), -COIN_DBL_MAX, 1);
    clp.primal();
    REQUIRE(clp.isProvenOptimal());
    const double inside = -clp.objectiveValue();
    CHECK(r.load_factor >= inside * (1 - 1e-6));
    // a pyramid of 64 edges is narrower than the cone by 1 - cos(pi / 64)
    CHECK(r.load_factor <= inside * 1.003);
  }
}

TEST_CASE("position, units, order and duplicated contacts do not change the forces for a load") {
  Random random(21);
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    auto points = test::around_ball(5 + i % 4, 0.5, 50 + i, i % 2 == 0 ? 0.003 : 0);
    Vector6d load;
    for (double& x : load) x = random.normal();
    load.tail<3>() *= 0.03;
    Held h = held(points);
    const ForceResult r = hold(h, {.load = load});
    const auto same = [&](Held& other, const Vector6d& w, double factor) {
      const ForceResult again = hold(other, {.load = w});
      REQUIRE(again.status == r.status);
      CHECK(std::abs(again.objective - factor * r.objective) <= 1e-7 * factor * r.objective);
    };
    const Pose X{Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {0.3, -0.2, 0.5}};
    Held moved = held(points, X);
    Vector6d w = load;
    w.head<3>() = X.rotation * load.head<3>(), w.tail<3>() = X.rotation * load.tail<3>();
    same(moved, w, 1);
    auto mixed = points;
    std::reverse(mixed.begin(), mixed.end());
    Held reversed = held(mixed);
    same(reversed, load, 1);
    mixed.insert(mixed.end(), points.begin(), points.begin() + 3);
    Held doubled = held(mixed);
    same(doubled, load, 1);
    auto far = points;
    for (auto& p : far) p.p_O *= 1000, p.torsion_radius *= 1000;
    Held big = held(far);
    w = 1e6 * load;
    w.tail<3>() *= 1000;
    same(big, w, 1e6);
  }
}

TEST_CASE("sixty contacts, collinear contacts and no contacts are solved") {
  const Vector6d load = wrench(0, 0, -5, 0.01, 0, 0);
  for (const double radius : {0.0, 0.002}) {
    Held many = held(test::around_ball(60, 0.5, 4, radius));
    for (const ForceObjective by : {ForceObjective::min_sum, ForceObjective::min_norm,
                                    ForceObjective::min_max, ForceObjective::max_margin}) {
      const ForceOptions options{.load = load, .objective = by, .max_force = 2};
      check_forces(many, options, hold(many, options));
    }
  }
  std::vector<PointContact> row;
  for (int i = 0; i < 20; ++i)
    row.push_back(test::contact_at({0.01 * (i % 10), 0.02 * (i < 10 ? 1 : -1), 0},
                                   {0, i < 10 ? -1.0 : 1.0, 0}, 0.5));
  Held line = held(row);
  const ForceOptions carried{.load = wrench(0, 0, -1, 0, -0.045, 0)};
  check_forces(line, carried, hold(line, carried));

  Held none = held({});
  CHECK(hold(none, {}).status == ForceStatus::optimal);
  const ForceResult falls = hold(none, {.load = load});
  CHECK(falls.status == ForceStatus::infeasible);
  REQUIRE(falls.certificate.has_value());
  CHECK(falls.certificate->contact == -1);
  CHECK(falls.certificate->power > 0);
}

TEST_CASE("without balance, the unbalanced rest is minimal") {
  Held h = held(test::pinch(0));
  const ForceOptions options{.load = wrench(1, 2, 0, 0, 0.03, 0), .nearest = true};
  const ForceResult r = hold(h, options);
  REQUIRE(r.status == ForceStatus::optimal);
  CHECK((r.unbalanced - wrench(0, 2, 0, 0, 0.03, 0)).norm() < close_to);
  CHECK(std::abs(r.residual - std::hypot(2, 0.3)) < close_to);
}

TEST_CASE("invalid arguments of forces are rejected by name") {
  Held h = held(test::pinch(0.5));
  const auto refuse = [&](const ForceOptions& options, const char* message) {
    CHECK_THROWS_WITH_AS(hold(h, options), message, Error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse({.load = wrench(nan, 0, 0, 0, 0, 0)},
         "contact forces: load holds a number that is not finite");
  refuse({.max_force = 0.0}, "contact forces: max_force must be > 0 [N], got 0");
  refuse({.max_total_force = -1.0}, "contact forces: max_total_force must be > 0 [N], got -1");
  refuse({.total_force = nan}, "contact forces: total_force must be > 0 [N], got nan");
  ForceOptions options;
  options.joints.emplace();
  options.joints->total_torque = 0;
  refuse(options, "contact forces: total_torque must be > 0 [N m], got 0");
  options.joints->total_torque.reset();
  options.joints->limits = VectorXd::Ones(2);
  refuse(options, "contact forces: torque limits: expected 0, one per DOF, got 2");
  CHECK_THROWS_WITH_AS(max_load(h.world, h.grasp, {}), "largest load: the direction must not be 0",
                       Error);
}
