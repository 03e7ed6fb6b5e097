#include "grasp/measures.h"

#include "grasp/contact_polygon.h"

#include <set>

#include "base/error.h"
#include "grasp/held_object.h"
#include "io/read.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

double value(Held& h, std::string_view name) {
  MeasuredGrasp measured(h.world, h.grasp);
  return find_measure(name).of(measured);
}

// six fingers in the middle of a cube's faces, 0.1 m from the middle, which is rho
Held six_fingers(double mu) {
  std::vector<PointContact> points;
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0})
      points.push_back(contact_at(0.1 * side * Vector3d::Unit(k), -side * Vector3d::Unit(k), mu));
  return held(points);
}

}  // namespace

TEST_CASE("six fingers on a cube: G G^T is 6 for forces and 4 for torques") {
  Held h = six_fingers(0.5);
  CHECK(value(h, "least_singular_value") == doctest::Approx(2));
  CHECK(value(h, "isotropy") == doctest::Approx(2 / std::sqrt(6.0)));
  CHECK(value(h, "ellipsoid_volume") == doctest::Approx(std::pow(6, 1.5) * std::pow(4, 1.5)));
  CHECK(value(h, "centroid_distance") < 1e-12);
  CHECK(value(h, "epsilon") > 0);
}

TEST_CASE("a square of fingers has its area and no irregularity, wherever it stands") {
  std::vector<PointContact> points;
  for (const auto& p :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)})
    points.push_back(contact_at(0.05 * p + Vector3d(0, 0, 0.03), -p, 0.5));
  const Pose X{Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {3, -2, 5}};
  Held h = held(points, X);
  CHECK(value(h, "polygon_area") == doctest::Approx(0.005));
  CHECK(value(h, "polygon_irregularity") < 1e-9);
  CHECK(value(h, "centroid_distance") == doctest::Approx(0.03));
}

TEST_CASE("the weight is held by friction: two fingers press with weight over 2 mu each") {
  Held h = held(pinch(0.5, 0.01));
  const double weight = 9.80665 * h.world.body(h.grasp.object).mass;
  CHECK(value(h, "weight_effort") == doctest::Approx(weight / 0.5).epsilon(1e-7));
  // along the line of the fingers it needs no friction
  const Pose up = Pose::turn(std::numbers::pi / 2, Vector3d::UnitY());
  Held upright = held(pinch(0, 0), up);
  CHECK(value(upright, "weight_effort") == doctest::Approx(weight).epsilon(1e-7));
  Held slippery = held(pinch(0, 0));
  CHECK(value(slippery, "weight_effort") == std::numeric_limits<double>::infinity());
}

TEST_CASE("a grasp without contacts is worth nothing, by every measure") {
  Held h = held({});
  for (const char* name :
       {"epsilon", "volume", "least_singular_value", "ellipsoid_volume", "isotropy", "polygon_area",
        "hand_least_singular_value", "manipulability", "hand_isotropy", "contact_robustness",
        "grasp_robustness", "penetration"})
    CHECK_MESSAGE(value(h, name) == 0, name);
  CHECK(value(h, "polygon_irregularity") == 1);
  CHECK(value(h, "centroid_distance") == std::numeric_limits<double>::infinity());
  CHECK(value(h, "joint_margin") == std::numeric_limits<double>::infinity());
}

TEST_CASE("places of DOFs in their ranges: the middle is best, a limit worst") {
  Held h = six_fingers(0.5);
  const RobotSpec spec = read_robot("models/hands/barrett/barrett.cfg");
  h.grasp.hand = h.world.add_robot(spec, Pose());
  for (Contact& contact : h.grasp.contacts) contact.other = h.world.robot(h.grasp.hand).base;
  const auto& limits = h.world.robot(h.grasp.hand).limits;
  const auto place = [&](double part) {
    Eigen::VectorXd q(static_cast<Eigen::Index>(limits.size()));
    for (Eigen::Index i = 0; i < q.size(); ++i)
      q[i] = limits[i][0] + part * (limits[i][1] - limits[i][0]);
    h.world.set_dofs(h.grasp.hand, q);
  };
  for (const double part : {0.5, 0.25, 0.0, 0.9}) {
    place(part);
    CHECK(value(h, "joint_margin") == doctest::Approx(std::min(part, 1 - part)));
    CHECK(value(h, "joint_deviation") == doctest::Approx(std::pow(2 * part - 1, 2)));
  }
}

TEST_CASE("no measure changes when the world is moved") {
  Random random(4);
  for (int round = 0; round < 3; ++round) {
    const auto points = around_ball(6, 0.6, 10 + round, round == 2 ? 0.01 : 0);
    Held here = held(points);
    Held there = held(points, {Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {1, 2, 3}});
    for (const Measure& measure : measures()) {
      // gravity is the world's: the weight pulls another way
      if (measure.name == "weight_effort" || measure.name.ends_with("robustness")) continue;
      const double a = value(here, measure.name), b = value(there, measure.name);
      if (a != b) CHECK_MESSAGE(a == doctest::Approx(b).epsilon(1e-9), measure.name);
    }
  }
}

TEST_CASE("soft fingers hold more than points") {
  Held hard = held(pinch(0.5)), soft = held(pinch(0.5, 0.02));
  CHECK(value(hard, "least_singular_value") == 0);
  CHECK(value(soft, "least_singular_value") > 0);
  CHECK(value(hard, "contact_robustness") == 0);
  CHECK(value(soft, "grasp_robustness") >= value(soft, "contact_robustness"));
}

TEST_CASE("measures have different names, a range, a unit and a source each") {
  std::set<std::string_view> names;
  for (const Measure& m : measures()) {
    CHECK(names.insert(m.name).second);
    for (const auto text : {m.what, m.range, m.unit, m.source}) CHECK_FALSE(text.empty());
  }
  CHECK_THROWS_WITH_AS(find_measure("epsilom"),
                       "unknown measure 'epsilom'; did you mean 'epsilon'?", Error);
}

TEST_CASE("contacts that are there twice change neither the polygon nor its middle") {
  const std::vector<Vector3d> once = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Vector3d> twice = once;
  twice.push_back(once[1]), twice.push_back(once[1]);
  const ContactPolygon a = contact_polygon(once), b = contact_polygon(twice);
  CHECK(a.centroid == b.centroid);
  CHECK(a.area == b.area);
}
