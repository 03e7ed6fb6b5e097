#include "clench/contact/friction_edges.h"

#include "clench/base/error.h"

using namespace clench;

TEST_CASE("a point contact has eight unit directions in its plane") {
  const auto edges = friction_edges();
  REQUIRE(edges.cols() == 8);
  for (int i = 0; i < 8; ++i) {
    CHECK(edges.col(i).head<2>().norm() == doctest::Approx(1));
    CHECK(edges.col(i).tail<4>().isZero(0));
  }
  CHECK(edges.rowwise().sum().norm() < 1e-15);  // eight rounding errors of numbers below 1
}

TEST_CASE("the edges of a soft contact lie on its ellipsoid, for torques of both signs") {
  for (const double radius : {1e-4, 1.64e-3, 0.05}) {
    const auto edges = friction_edges(radius);
    REQUIRE(edges.cols() == 20);
    for (int i = 0; i < 20; ++i) {
      const double torque = edges(5, i) / radius;
      CHECK(edges.col(i).head<2>().squaredNorm() + torque * torque == doctest::Approx(1));
      CHECK(edges.col(i).segment<3>(2).isZero(0));
    }
    CHECK(edges.row(5).maxCoeff() == doctest::Approx(radius));
    CHECK(edges.row(5).minCoeff() == doctest::Approx(-radius));
    // the poles are pure torques about the normal
    CHECK(edges.col(0).head<2>().isZero(0));
    CHECK(edges.col(19).head<2>().isZero(0));
  }
}

TEST_CASE("the edges in the files of the Barrett hand's virtual contacts are reproduced") {
  // torsion radius 1.640803 mm in the file; its edges have six digits
  const auto edges = friction_edges(1.640803e-3);
  CHECK(edges(0, 1) == doctest::Approx(0.853909).epsilon(1e-6));
  CHECK(edges(5, 1) == doctest::Approx(0.853909e-3).epsilon(1e-6));
  CHECK(edges(0, 2) == doctest::Approx(0.263873).epsilon(1e-5));
  CHECK(edges(1, 2) == doctest::Approx(0.812116).epsilon(1e-6));
  CHECK(edges(0, 7) == doctest::Approx(0.707107).epsilon(1e-6));
}

TEST_CASE("a negative torsion radius is rejected") {
  CHECK_THROWS_WITH_AS(friction_edges(-1),
                       "friction edges: expected a torsion radius >= 0 [m], got -1", Error);
  CHECK_THROWS_AS(friction_edges(NAN), Error);
}

TEST_CASE("any number of directions: rings on both sides of the equator, up to the poles") {
  CHECK(friction_edges(0, 5).cols() == 5);
  CHECK(friction_edges(0.01, 3).cols() == 5);    // 1, 3, 1
  CHECK(friction_edges(0.01, 16).cols() == 80);  // 1, 6, 11, 14, 16, 14, 11, 6, 1
  for (const int directions : {3, 4, 7, 12, 100, 1000}) {
    const auto edges = friction_edges(0.003, directions);
    for (const auto& e : edges.colwise())
      CHECK(e.head<2>().squaredNorm() + std::pow(e[5] / 0.003, 2) == doctest::Approx(1));
    CHECK(edges.row(5).maxCoeff() == doctest::Approx(0.003));
  }
  CHECK_THROWS_WITH_AS(friction_edges(0, 2), "friction edges: expected 3 directions or more, got 2",
                       Error);
}

TEST_CASE("latitudes that are even in units of the radius are equal for every radius") {
  const auto one = friction_edges(1, 8, 1);
  REQUIRE(one.cols() == 20);
  for (const double radius : {1e-6, 0.003, 0.05, 700.0}) {
    auto edges = friction_edges(radius, 8, radius);
    edges.row(5) /= radius;
    CHECK((edges - one).cwiseAbs().maxCoeff() < 1e-15);
  }
  // at a latitude of 45 degrees
  CHECK(one(5, 1) == doctest::Approx(std::sqrt(0.5)));
  // not so if the unit of torque differs from the radius by far
  CHECK(friction_edges(1, 8, 1e-3)(5, 1) < 2e-3);
}
