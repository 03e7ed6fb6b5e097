#include "clench/math/cones.h"

#include "clench/base/random.h"

using namespace clench;
using Eigen::VectorXd;

static const ConeSizes three_cones = {1, 3, 4};

static VectorXd any_vector(Random& random) {
  VectorXd v(8);
  for (double& x : v) x = random.normal();
  return v;
}

static VectorXd inside_cones(Random& random) {
  VectorXd v = any_vector(random);
  return v + (0.01 - std::min(0.0, cone_margin(three_cones, v))) * cone_unit(three_cones);
}

TEST_CASE("Nesterov-Todd scaling maps s and z to one point, and its inverse maps it back") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const VectorXd s = inside_cones(random), z = inside_cones(random), v = any_vector(random);
    const NesterovTodd scaling(three_cones, s, z);
    // the margins from the cones are 0.01 and more: condition numbers of 1e4
    CHECK((scaling.apply(z) - scaling.lambda()).norm() < 1e-11);
    CHECK((scaling.apply_inverse(s) - scaling.lambda()).norm() < 1e-9);
    CHECK((scaling.apply_inverse(scaling.apply(v)) - v).norm() < 1e-9);
    CHECK(cone_margin(three_cones, scaling.lambda()) > 0);
    const NesterovTodd one(three_cones);
    CHECK(one.apply(v) == v);
  }
}

TEST_CASE("division in the cones' algebra inverts the product") {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const VectorXd a = inside_cones(random), b = any_vector(random);
    CHECK((cone_divide(three_cones, a, cone_product(three_cones, a, b)) - b).norm() < 1e-10);
    CHECK(cone_product(three_cones, a, cone_unit(three_cones)) == a);
  }
}

TEST_CASE("the longest step ends on the boundary") {
  Random random(3);
  int ends = 0;
  for (int i = 0; i < 300; ++i) {
    const VectorXd v = inside_cones(random), dv = any_vector(random);
    const double step = longest_step(three_cones, v, dv);
    if (std::isfinite(step)) {
      ++ends;
      CHECK(std::abs(cone_margin(three_cones, v + step * dv)) < 1e-9 * (1 + step));
      CHECK(cone_margin(three_cones, v + 0.999 * step * dv) > 0);
    } else {
      CHECK(cone_margin(three_cones, v + 1e6 * dv) > 0);
    }
    CHECK(longest_step(three_cones, v, inside_cones(random)) ==
          std::numeric_limits<double>::infinity());
  }
  CHECK(ends > 200);
}

TEST_CASE("a step through the tip of a cone ends there") {
  VectorXd v(3), dv(3);
  v << 1, 0, 0;
  dv << -1.2, 0, 0;
  CHECK(longest_step({3}, v, dv) == doctest::Approx(1 / 1.2));
  v << 3, 1, 2;
  CHECK(longest_step({3}, v, -v / 3) == doctest::Approx(3));
}

TEST_CASE("the margin is the smallest margin of all cones") {
  VectorXd v(4);
  v << 2, 5, 3, 4;
  CHECK(cone_margin({1, 3}, v) == 0);
  CHECK(cone_margin({1, 1, 2}, v) == -1);
  CHECK(cone_margin({}, VectorXd()) == std::numeric_limits<double>::infinity());
}
