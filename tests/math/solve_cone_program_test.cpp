#include "clench/math/solve_cone_program.h"

#include <coin/ClpSimplex.hpp>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/math/cones.h"
#include "clench/math/scale_program.h"

using namespace clench;
using Eigen::MatrixXd, Eigen::VectorXd;

// accuracy guaranteed by the header; the checks below use other norms, hence the factor
static constexpr double promised = 1e-9, close_to_it = 1e-8;

static MatrixXd normal_matrix(Random& random, int rows, int columns) {
  MatrixXd m(rows, columns);
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

static double biggest(const VectorXd& v) { return v.size() == 0 ? 0 : v.cwiseAbs().maxCoeff(); }

static ConeSizes all_cones(const ConeProgram& p) {
  ConeSizes sizes(p.nonnegative, 1);
  sizes.insert(sizes.end(), p.cones.begin(), p.cones.end());
  return sizes;
}

static VectorXd times(const MatrixXd& m, const VectorXd& v, Eigen::Index rows) {
  return m.size() == 0 ? VectorXd(VectorXd::Zero(rows)) : VectorXd(m * v);
}

// the optimality conditions, with plain sums and each residual relative to the largest of its terms
static void check_optimum(const ConeProgram& p, const ConeSolution& r) {
  REQUIRE(r.status == ConeStatus::optimal);
  const auto n = p.c.size();
  const VectorXd Px = times(p.P, r.x, n), Ax = times(p.A, r.x, p.b.size()),
                 Gx = times(p.G, r.x, p.h.size());
  const VectorXd Aty = times(p.A.transpose(), r.y, n), Gtz = times(p.G.transpose(), r.z, n);
  // if all data are 0, numbers are compared with 1
  const auto size_or_one = [](double x) { return x > 0 ? x : 1; };
  const double given = size_or_one(std::max(biggest(p.b), biggest(p.h)));
  const double primal = std::max({given, biggest(Ax), biggest(r.s)});
  CHECK(std::max({r.primal_residual, r.dual_residual, r.gap}) <= promised);
  CHECK(biggest(Ax - p.b) <= close_to_it * primal);
  CHECK(biggest(Gx + r.s - p.h) <= close_to_it * primal);
  const double asked =
      size_or_one(std::max(biggest(p.c), p.P.size() > 0 ? given * p.P.cwiseAbs().maxCoeff() : 0));
  const double dual = std::max({asked, biggest(Px), biggest(Aty), biggest(Gtz)});
  CHECK(biggest(Px + p.c + Aty + Gtz) <= close_to_it * dual);
  CHECK(cone_margin(all_cones(p), r.s) >= -1e-14 * primal);
  CHECK(cone_margin(all_cones(p), r.z) >= -1e-14 * dual);
  CHECK(r.s.dot(r.z) <= close_to_it * primal * dual * std::max<double>(1, p.h.size()));
}

static void check_infeasible(const ConeProgram& p, const ConeSolution& r) {
  REQUIRE(r.status == ConeStatus::infeasible);
  CHECK(std::abs(p.b.dot(r.y) + p.h.dot(r.z) + 1) < 1e-9);
  const auto n = p.c.size();
  const VectorXd sum = times(p.A.transpose(), r.y, n) + times(p.G.transpose(), r.z, n);
  // relative to the largest numbers in the sum
  const double term = std::max(p.A.size() > 0 ? p.A.cwiseAbs().maxCoeff() * biggest(r.y) : 0,
                               p.G.size() > 0 ? p.G.cwiseAbs().maxCoeff() * biggest(r.z) : 0);
  CHECK(biggest(sum) <= close_to_it * term);
  CHECK(cone_margin(all_cones(p), r.z) >= -1e-14 * biggest(r.z));
}

static void check_unbounded(const ConeProgram& p, const ConeSolution& r) {
  REQUIRE(r.status == ConeStatus::unbounded);
  CHECK(std::abs(p.c.dot(r.x) + 1) < 1e-9);
  const double size = biggest(r.x);
  CHECK(biggest(times(p.P, r.x, p.c.size())) <= close_to_it * size);
  CHECK(biggest(times(p.A, r.x, p.b.size())) <= close_to_it * size);
  CHECK(biggest(times(p.G, r.x, p.h.size()) + r.s) <= close_to_it * size);
  CHECK(cone_margin(all_cones(p), r.s) >= -1e-14 * size);
}

// s and z of a cone with s.z = 0: one of them 0, or both on the boundary, opposite
static void complementary(Random& random, int size, VectorXd& s, VectorXd& z) {
  s = z = VectorXd::Zero(size);
  const VectorXd u = normal_matrix(random, size, 1);
  const int kind = static_cast<int>(random.bits() % 3);
  VectorXd inside = u;
  inside[0] = u.tail(size - 1).norm() + 0.1 + std::abs(u[0]);
  if (kind == 0) s = inside;
  if (kind == 1) z = inside;
  if (kind == 2 && size > 1) {
    const double a = random.uniform(0.1, 2), b = random.uniform(0.1, 2);
    s << u.tail(size - 1).norm(), u.tail(size - 1);
    z << s[0], -s.tail(size - 1);
    s *= a, z *= b;
  }
}

// a program made from its solution
struct Made {
  ConeProgram program;
  VectorXd x;
  double objective = 0;
};

static Made made_program(Random& random, bool curved) {
  const auto upto = [&](int most) { return static_cast<int>(random.bits() % (most + 1)); };
  Made m;
  ConeProgram& p = m.program;
  const int n = 1 + upto(11);
  p.nonnegative = upto(8);
  for (int k = upto(5); k > 0; --k) p.cones.push_back(1 + upto(4));
  VectorXd s(0), z(0);
  for (const int size : all_cones(p)) {
    VectorXd a, b;
    complementary(random, size, a, b);
    s.conservativeResize(s.size() + size), z.conservativeResize(z.size() + size);
    s.tail(size) = a, z.tail(size) = b;
  }
  const int rows = static_cast<int>(s.size()), equal = upto(n / 2);
  m.x = normal_matrix(random, n, 1);
  p.A = normal_matrix(random, equal, n);
  p.G = normal_matrix(random, rows, n);
  p.b = p.A * m.x;
  p.h = p.G * m.x + s;
  const VectorXd y = normal_matrix(random, equal, 1);
  p.c = -p.A.transpose() * y - p.G.transpose() * z;
  if (curved) {
    const MatrixXd half = normal_matrix(random, 1 + upto(n - 1), n);
    p.P = half.transpose() * half;
    p.c -= p.P * m.x;
    m.objective = 0.5 * m.x.dot(p.P * m.x);
  }
  m.objective += p.c.dot(m.x);
  return m;
}

TEST_CASE("programs made from their solution have that solution") {
  Random random(11);
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    const Made made = made_program(random, i % 2 == 0);
    const ConeSolution r = solve(made.program);
    check_optimum(made.program, r);
    // the largest term is some ten times ten numbers of order 1
    CHECK(std::abs(r.objective - made.objective) <
          1e-7 * std::max({1.0, std::abs(made.objective), biggest(made.program.c)}));
  }
}

TEST_CASE("neither units nor powers of ten of rows and columns change the solution") {
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    Made made = made_program(random, i % 2 == 0);
    ConeProgram p = made.program;
    // x' = x / columns; rows times factors, one per cone; objective times another
    const double whole = std::pow(10, random.uniform(-8, 8));
    VectorXd columns(p.c.size());
    for (double& x : columns) x = std::pow(10, random.uniform(-3, 3));
    const double right = std::pow(10, random.uniform(-8, 8));
    p.A = p.A * columns.asDiagonal(), p.G = p.G * columns.asDiagonal();
    p.b *= right, p.h *= right;
    p.c = columns.cwiseProduct(p.c) * whole;
    if (p.P.size() > 0) p.P = columns.asDiagonal() * p.P * columns.asDiagonal() * (whole / right);
    for (int k = 0; k < p.b.size(); ++k) {
      const double factor = std::pow(10, random.uniform(-6, 6));
      p.A.row(k) *= factor, p.b[k] *= factor;
    }
    int start = 0;
    for (const int size : all_cones(p)) {
      const double factor = std::pow(10, random.uniform(-6, 6));
      p.G.middleRows(start, size) *= factor, p.h.segment(start, size) *= factor;
      start += size;
    }
    const ConeSolution r = solve(p);
    REQUIRE(r.status == ConeStatus::optimal);
    const double expected = made.objective * whole * right;
    CHECK(std::abs(r.objective - expected) <
          1e-6 * whole * right *
              std::max({1.0, std::abs(made.objective), biggest(made.program.c)}));
  }
}

TEST_CASE("powers of two as units give bit-identical results") {
  Random random(13);
  for (int i = 0; i < 50; ++i) {
    const Made made = made_program(random, i % 2 == 0);
    const ConeSolution r = solve(made.program);
    ConeProgram p = made.program;
    p.b *= 1024, p.h *= 1024;
    p.P /= 1024;
    const ConeSolution again = solve(p);
    CHECK(again.x == 1024 * r.x);
    CHECK(again.z == r.z);
  }
}

TEST_CASE("infeasible programs are proved to be infeasible") {
  Random random(14);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    // h below all values of G x: z in the cones with G^T z + A^T y = 0 and h.z + b.y < 0
    Made made = made_program(random, i % 2 == 0);
    ConeProgram& p = made.program;
    // in a single row only rounding errors would remain
    if (p.h.size() < 2) continue;
    VectorXd z =
        cone_unit(all_cones(p)) + 0.2 * normal_matrix(random, static_cast<int>(p.h.size()), 1) /
                                      std::sqrt(static_cast<double>(p.h.size()));
    REQUIRE(cone_margin(all_cones(p), z) > 0);
    const VectorXd y = normal_matrix(random, static_cast<int>(p.b.size()), 1);
    // columns made orthogonal to (y, z)
    VectorXd both(y.size() + z.size());
    both << y, z;
    for (int k = 0; k < p.c.size(); ++k) {
      const double off = times(p.A.transpose(), y, p.c.size())[k] + p.G.col(k).dot(z);
      if (p.A.size() > 0) p.A.col(k) -= off / both.squaredNorm() * y;
      p.G.col(k) -= off / both.squaredNorm() * z;
    }
    const double value = p.b.dot(y) + p.h.dot(z);
    p.h -= (value + 1) / z.squaredNorm() * z;
    check_infeasible(p, solve(p));
  }
}

TEST_CASE("unbounded programs are reported, with a direction") {
  Random random(15);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    Made made = made_program(random, false);
    ConeProgram& p = made.program;
    // a column that leads into all cones, and improves the objective
    const VectorXd unit = cone_unit(all_cones(p));
    if (p.G.size() > 0) p.G.col(0) = -unit;
    if (p.A.size() > 0) p.A.col(0).setZero();
    p.c[0] = -1;
    check_unbounded(p, solve(p));
  }
}

// the same by the simplex method; all cones of G are half lines
static ClpSimplex by_simplex(const ConeProgram& p) {
  const int n = static_cast<int>(p.c.size());
  const int equal = static_cast<int>(p.b.size()), rows = static_cast<int>(p.h.size());
  ClpSimplex clp;
  clp.setLogLevel(0);
  clp.resize(0, n);
  for (int k = 0; k < n; ++k) {
    clp.setColumnBounds(k, -COIN_DBL_MAX, COIN_DBL_MAX);
    clp.setObjectiveCoefficient(k, p.c[k]);
  }
  std::vector<int> columns(n);
  for (int k = 0; k < n; ++k) columns[k] = k;
  const auto add = [&](const VectorXd& row, double low, double high) {
    clp.addRow(n, columns.data(), row.data(), low, high);
  };
  for (int k = 0; k < equal; ++k) add(p.A.row(k), p.b[k], p.b[k]);
  for (int k = 0; k < rows; ++k) add(p.G.row(k), -COIN_DBL_MAX, p.h[k]);
  clp.setPrimalTolerance(1e-9);
  clp.setDualTolerance(1e-9);
  clp.primal();
  return clp;
}

TEST_CASE(
    "linear programs agree with the simplex method, including infeasible and unbounded ones") {
  Random random(16);
  int found[3] = {};
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    ConeProgram p;
    const int n = 2 + i % 7, rows = n + i % 11;
    p.nonnegative = rows;
    p.G = normal_matrix(random, rows, n);
    p.h = normal_matrix(random, rows, 1).array() + random.uniform(-0.5, 2);
    p.A = normal_matrix(random, i % 3, n);
    p.b = normal_matrix(random, i % 3, 1);
    p.c = normal_matrix(random, n, 1);
    ClpSimplex clp = by_simplex(p);
    const ConeSolution r = solve(p);
    if (clp.isProvenOptimal()) {
      ++found[0];
      check_optimum(p, r);
      // Clp's tolerance, summed over the rows
      CHECK(std::abs(r.objective - clp.objectiveValue()) <
            1e-7 * std::max(1.0, std::abs(clp.objectiveValue())));
    } else if (clp.isProvenPrimalInfeasible()) {
      // a problem that is both infeasible and unbounded may be reported as either
      if (r.status != ConeStatus::unbounded) check_infeasible(p, r);
      ++found[1];
    } else {
      REQUIRE(clp.isProvenDualInfeasible());
      if (r.status != ConeStatus::infeasible) check_unbounded(p, r);
      ++found[2];
    }
  }
  for (const int count : found) CHECK(count > 20);
}

TEST_CASE("the nearest point of a cone is that of its closed formula") {
  Random random(17);
  for (int i = 0; i < 100; ++i) {
    const int size = 2 + i % 5;
    const VectorXd at = normal_matrix(random, size, 1);
    ConeProgram p;
    p.P = MatrixXd::Identity(size, size);
    p.c = -at;
    p.G = -MatrixXd::Identity(size, size);
    p.h = VectorXd::Zero(size);
    p.cones = {size};
    const double t = at[0], norm = at.tail(size - 1).norm();
    VectorXd expected = VectorXd::Zero(size);
    if (norm <= t) {
      expected = at;
    } else if (norm > -t) {
      expected[0] = (t + norm) / 2;
      expected.tail(size - 1) = expected[0] / norm * at.tail(size - 1);
    }
    const ConeSolution r = solve(p);
    check_optimum(p, r);
    // an error e of a strictly convex objective is an error sqrt(e) of the position
    CHECK(biggest(r.x - expected) < 1e-4);
    CHECK(std::abs((r.x - at).norm() - (expected - at).norm()) < 1e-8);
  }
}

TEST_CASE("duplicate, empty and contradictory equations are handled") {
  Random random(18);
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const Made made = made_program(random, i % 2 == 0);
    ConeProgram p = made.program;
    const int equal = static_cast<int>(p.b.size());
    if (equal == 0) continue;
    // each of the rows twice in different units, sums of them, and one of zeros
    MatrixXd mix = MatrixXd::Zero(2 * equal + 2, equal);
    mix.topRows(equal).setIdentity();
    mix.middleRows(equal, equal) = 3.7e5 * MatrixXd::Identity(equal, equal);
    mix.row(2 * equal) = normal_matrix(random, 1, equal);
    p.A = mix * p.A;
    p.b = mix * p.b;
    const ConeSolution r = solve(p);
    check_optimum(p, r);
    CHECK(std::abs(r.objective - made.objective) <
          1e-7 * std::max({1.0, std::abs(made.objective), biggest(made.program.c)}));
    // one contradictory row
    p.b[i % (2 * equal + 2)] += 1 + std::abs(p.b[i % (2 * equal + 2)]);
    check_infeasible(p, solve(p));
  }
}

TEST_CASE("trivial programs have an answer") {
  ConeProgram nothing;
  CHECK(solve(nothing).status == ConeStatus::optimal);

  ConeProgram idle;  // an unknown without constraints or cost
  idle.c = VectorXd::Zero(2);
  CHECK(solve(idle).status == ConeStatus::optimal);
  idle.c[1] = 1;
  check_unbounded(idle, solve(idle));

  ConeProgram no_unknowns;
  no_unknowns.A = MatrixXd::Zero(1, 0);
  no_unknowns.b = VectorXd::Constant(1, 2.0);
  check_infeasible(no_unknowns, solve(no_unknowns));
  no_unknowns.b[0] = 0;
  CHECK(solve(no_unknowns).status == ConeStatus::optimal);

  ConeProgram apex;  // a cone of which only the tip is feasible
  apex.c = VectorXd::Ones(3);
  apex.G = -MatrixXd::Identity(3, 3);
  apex.h = VectorXd::Zero(3);
  apex.cones = {3};
  apex.A = MatrixXd::Zero(1, 3);
  apex.A(0, 0) = 1;
  apex.b = VectorXd::Zero(1);
  const ConeSolution tip = solve(apex);
  CHECK((tip.status == ConeStatus::optimal || tip.status == ConeStatus::inaccurate));
  CHECK(biggest(tip.x) <
        1e-4);  // no interior: the curvature of the cone leaves the root of the residual
}

TEST_CASE("any program gets an answer in finite numbers") {
  Random random(19);
  int counts[4] = {};
  for (int i = 0; i < 600; ++i) {
    CAPTURE(i);
    // small numbers are rounded to 0 or to ties: rows and columns vanish, repeat and oppose each
    // other
    ConeProgram p = made_program(random, i % 2 == 0).program;
    const double coarse = i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 0.5;
    const auto round_off = [&](MatrixXd& m) {
      for (double& x : m.reshaped()) x = coarse * std::round(x / coarse);
    };
    MatrixXd b = p.b, h = p.h, c = p.c;
    round_off(p.A), round_off(p.G), round_off(b), round_off(h), round_off(c);
    p.b = b, p.h = h, p.c = c;
    if (i % 5 == 0) p.h.setZero(), p.b.setZero();
    if (i % 7 == 0) p.c.setZero();
    const ConeSolution r = solve(p);
    ++counts[static_cast<int>(r.status)];
    CHECK((r.x.allFinite() && r.y.allFinite() && r.z.allFinite() && r.s.allFinite()));
    CHECK(std::isfinite(r.objective + r.primal_residual + r.dual_residual + r.gap));
    if (r.status == ConeStatus::optimal) check_optimum(p, r);
    if (r.status == ConeStatus::infeasible) check_infeasible(p, r);
    if (r.status == ConeStatus::unbounded) check_unbounded(p, r);
  }
  CHECK(counts[0] > 100);
  CHECK(counts[1] > 20);
  CHECK(counts[2] > 20);
  CHECK(counts[3] < 6);  // an optimum that is approached but not attained
}

TEST_CASE("the same program gives bit-identical results") {
  Random random(20);
  const Made made = made_program(random, true);
  const ConeSolution a = solve(made.program), b = solve(made.program);
  CHECK(a.x == b.x);
  CHECK(a.z == b.z);
  CHECK(a.iterations == b.iterations);
}

TEST_CASE("a program with inconsistent sizes is rejected") {
  ConeProgram p;
  p.c = VectorXd::Ones(2);
  const auto refuse = [](const ConeProgram& bad, const char* message) {
    CHECK_THROWS_WITH_AS(solve(bad), message, Error);
  };
  ConeProgram bad = p;
  bad.P = MatrixXd::Zero(3, 2);
  refuse(bad, "cone program: rows of P: expected 2, got 3");
  bad.P = MatrixXd::Zero(2, 3);
  refuse(bad, "cone program: columns of P: expected 2, got 3");
  bad = p;
  bad.A = MatrixXd::Zero(1, 2);
  refuse(bad, "cone program: rows of A: expected 0, got 1");
  bad.A = MatrixXd::Zero(1, 3), bad.b = VectorXd::Zero(1);
  refuse(bad, "cone program: columns of A: expected 2, got 3");
  bad = p;
  bad.G = MatrixXd::Zero(1, 2);
  refuse(bad, "cone program: rows of G: expected 0, got 1");
  bad.G = MatrixXd::Zero(1, 3), bad.h = VectorXd::Zero(1);
  refuse(bad, "cone program: columns of G: expected 2, got 3");
  bad = p;
  bad.nonnegative = -1;
  refuse(bad, "cone program: nonnegative must be >= 0, got -1");
  bad.nonnegative = 1;
  refuse(bad, "cone program: rows of the cones: expected 0, got 1");
  bad = p;
  bad.cones = {0};
  refuse(bad, "cone program: a cone's size must be >= 1, got 0");
  bad = p;
  bad.c[1] = std::numeric_limits<double>::quiet_NaN();
  refuse(bad, "cone program: c holds a number that is not finite");
}
