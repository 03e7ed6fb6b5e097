#include "clench/contact/cone.h"

#include <limits>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "support/measured.h"
#include "support/shared.h"

using namespace clench;

static Eigen::Vector3d random_unit(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

TEST_CASE("a contact frame is right-handed with z along the normal") {
  Random random(1);
  std::vector<Eigen::Vector3d> normals = {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitX(),
                                          Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(),
                                          Eigen::Vector3d(1, 1e-7, 0).normalized()};
  for (int i = 0; i < 200; ++i) normals.push_back(random_unit(random));
  for (const Eigen::Vector3d& n : normals) {
    const Eigen::Matrix3d frame = contact_frame(n);
    CHECK(frame.col(2) == n);
    // within a few rounding errors
    CHECK((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(frame.determinant() == doctest::Approx(1).epsilon(1e-14));
  }
  CHECK(contact_frame(Eigen::Vector3d::UnitZ()).col(0) == Eigen::Vector3d::UnitY());
  CHECK(contact_frame(Eigen::Vector3d::UnitX()).col(0) == -Eigen::Vector3d::UnitY());
}

TEST_CASE("every edge is inclined to the normal by the friction angle, counter-clockwise from x") {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const PointContact contact{.p_O = random_unit(random), .n_O = random_unit(random), .mu = 0.5};
    const auto wrenches = cone_wrenches(contact, {.edges = 12});
    REQUIRE(wrenches.cols() == 12);
    const Eigen::Matrix3d frame = contact_frame(contact.n_O);
    for (int j = 0; j < 12; ++j) {
      const Eigen::Vector3d f_C = frame.transpose() * wrenches.col(j).head<3>();
      CHECK(f_C.z() == doctest::Approx(1));
      CHECK(f_C.head<2>().norm() == doctest::Approx(0.5));
      const double expected = 2 * std::numbers::pi * j / 12;
      // sine and cosine of the angle: continuous over a full turn
      CHECK(f_C.x() == doctest::Approx(0.5 * std::cos(expected)).epsilon(1e-12));
      CHECK(f_C.y() == doctest::Approx(0.5 * std::sin(expected)).epsilon(1e-12));
    }
  }
}

TEST_CASE("torque is the lever about the given point times force, divided by rho") {
  const PointContact contact{.p_O = {0.3, -0.2, 0.5}, .n_O = {0, 1, 0}, .mu = 0.7};
  const Eigen::Vector3d about(0.1, 0.1, -0.2);
  const auto wrenches = cone_wrenches(contact, {.edges = 5, .rho = 0.25, .p_OM = about});
  for (const auto& w : wrenches.colwise()) {
    const Eigen::Vector3d torque = (contact.p_O - about).cross(Eigen::Vector3d(w.head<3>()));
    CHECK((0.25 * w.tail<3>() - torque).norm() < 1e-15);  // rounding of numbers below 1
  }
}

TEST_CASE("without friction the cone is its normal") {
  const auto wrenches = cone_wrenches({.p_O = {1, 0, 0}, .n_O = {0, 0, 1}, .mu = 0});
  REQUIRE(wrenches.cols() == 1);
  CHECK(wrenches.col(0) == (Eigen::Matrix<double, 6, 1>() << 0, 0, 1, 0, -1, 0).finished());
}

TEST_CASE("a bad contact or option is rejected by name and value") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [](const PointContact& contact, const ConeOptions& options, const char* why) {
    CHECK_THROWS_WITH_AS(cone_wrenches(contact, options), why, Error);
  };
  refuse({.mu = -0.1}, {}, "contact cone: mu: expected a number from 0 to 1e+06, got -0.1");
  refuse({.mu = nan}, {}, "contact cone: mu: expected a number from 0 to 1e+06, got nan");
  refuse({.torsion_radius = -1}, {}, "contact cone: torsion_radius must be >= 0, got -1");
  refuse({.n_O = {0, 0, 2}}, {}, "contact cone: the normal must be a unit vector, got length 2");
  refuse({.n_O = {0, 0, nan}}, {},
         "contact cone: the normal must be a unit vector, got length nan");
  refuse({.p_O = {nan, 0, 0}}, {}, "contact cone: the point must be finite");
  refuse({}, {.edges = 2}, "contact cone: edges must be 3 to 1000, got 2");
  refuse({}, {.edges = 2000000000}, "contact cone: edges must be 3 to 1000, got 2000000000");
  refuse({}, {.rho = 0}, "contact cone: rho must be > 0, got 0");
  refuse({}, {.rho = nan}, "contact cone: rho must be > 0, got nan");
  refuse({}, {.p_OM = {0, nan, 0}}, "contact cone: the point of torques must be finite");
}

TEST_CASE("the wrenches of the original's contacts are reproduced") {
  REQUIRE_SHARED();
  int compared = 0;
  for (const char* name : {"dlr_flask", "barrett_flask_bestSA", "plannerMug"}) {
    const auto measured = test::measured("autograsp_" + std::string(name));
    const auto vector = [](const nlohmann::json& v) {
      return Eigen::Vector3d(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
    };
    // millimeters throughout: the ratio to rho is dimensionless
    ConeOptions options{.rho = measured["gws_max_radius"], .p_OM = vector(measured["gws_cog"])};
    for (const auto& c : measured["grasp_contact_list"]) {
      options.edges = c["friction_edges"];
      const PointContact contact{
          .p_O = vector(c["pos_body1"]), .n_O = vector(c["normal_body1"]), .mu = c["cof"]};
      const auto ours = cone_wrenches(contact, options);
      const auto& theirs = c["wrenches_fx_fy_fz_tx_ty_tz"];
      REQUIRE(ours.cols() == static_cast<int>(theirs.size()));
      for (int j = 0; j < ours.cols(); ++j)
        for (int row = 0; row < 6; ++row, ++compared)
          // the original prints 17 digits; the numbers are of order 1
          CHECK(std::abs(ours(row, j) - theirs[j][row].get<double>()) < 1e-9);
    }
  }
  CHECK(compared > 500);
}

TEST_CASE(
    "the edges of a soft contact, 20 for 8, lie on its ellipsoid and add a torque about the "
    "normal") {
  const Eigen::Vector3d about(0.1, 0.1, -0.2);
  const PointContact contact{
      .p_O = {0.3, -0.2, 0.5}, .n_O = {0, 0.6, 0.8}, .mu = 0.7, .torsion_radius = 0.004};
  for (const int edges : {3, 8, 16, 100}) {
    const ConeOptions options{.edges = edges, .rho = 0.25, .p_OM = about};
    const auto wrenches = cone_wrenches(contact, options);
    if (edges == 8) CHECK(wrenches.cols() == 20);
    CHECK(wrenches.cols() > edges);
    for (const auto& w : wrenches.colwise()) {
      const Eigen::Vector3d force = w.head<3>();
      CHECK(force.dot(contact.n_O) == doctest::Approx(1));
      // the part of the torque beyond that of the lever is the torque about the normal
      const Eigen::Vector3d turn = 0.25 * w.tail<3>() - (contact.p_O - about).cross(force);
      CHECK(turn.cross(contact.n_O).norm() < 1e-15);
      const double across = (force - contact.n_O).squaredNorm();
      CHECK(across + std::pow(turn.norm() / 0.004, 2) == doctest::Approx(0.7 * 0.7));
    }
    // without a torsion radius it is a point contact
    const auto hard = cone_wrenches({contact.p_O, contact.n_O, contact.mu}, options);
    CHECK(hard.cols() == edges);
  }
  CHECK(cone_wrenches({.mu = 0, .torsion_radius = 0.1}).cols() == 1);
}

TEST_CASE(
    "a contact scaled by two, with torques divided by twice the length, has the same wrenches") {
  Random random(4);
  for (const double torsion : {0.0, 0.004})
    for (const double size : {1e-3, 0.5, 2.0, 37.0}) {
      PointContact contact{.p_O = random_unit(random), .n_O = random_unit(random), .mu = 0.6};
      contact.torsion_radius = torsion;
      const ConeOptions options{.rho = 0.5, .p_OM = random_unit(random)};
      PointContact large = contact;
      large.p_O *= size, large.torsion_radius *= size;
      const ConeOptions wide{.rho = size * options.rho, .p_OM = size * options.p_OM};
      // rounding errors of levers of length four
      CHECK((cone_wrenches(large, wide) - cone_wrenches(contact, options)).norm() < 1e-13);
      const RoundCone round = round_cone(large, wide), small = round_cone(contact, options);
      CHECK((round.axis - small.axis).norm() < 1e-14);
      CHECK((round.spread - small.spread).norm() < 1e-14);
    }
}

TEST_CASE("the edges of the pyramid lie on the rim of the round cone") {
  Random random(3);
  for (const double torsion : {0.0, 0.02}) {
    PointContact contact{.p_O = random_unit(random), .n_O = random_unit(random), .mu = 0.6};
    contact.torsion_radius = torsion;
    const ConeOptions options{.edges = 8, .rho = 0.5, .p_OM = random_unit(random)};
    const RoundCone cone = round_cone(contact, options);
    REQUIRE(cone.spread.cols() == (torsion > 0 ? 3 : 2));
    const auto wrenches = cone_wrenches(contact, options);
    for (const auto& w : wrenches.colwise()) {
      Eigen::Matrix<double, 6, 1> rest = w - cone.axis;
      double square = 0;
      for (int k = 0; k < cone.spread.cols(); ++k) {
        const int rows = k < 2 ? 3 : 6;
        const auto column = cone.spread.col(k).head(rows);
        const double x = column.dot(rest.head(rows)) / column.squaredNorm();
        rest -= x * cone.spread.col(k);
        square += x * x;
      }
      CHECK(rest.norm() < 1e-14);  // rounding errors of levers of length two
      CHECK(square == doctest::Approx(1));
    }
  }
  CHECK(round_cone({.mu = 0}).spread.cols() == 0);
  CHECK_THROWS_WITH_AS(round_cone({.mu = -0.5}),
                       "contact cone: mu: expected a number from 0 to 1e+06, got -0.5", Error);
}
