#include "clench/grasp/measure/measures.h"

#include "clench/grasp/measure/contact_polygon.h"

#include <set>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "grasp/held_object.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

double value(Held& h, std::string_view name) {
  MeasuredGrasp measured(h.world, h.grasp);
  return find_measure(name).of(measured);
}

// six fingers at the centers of a cube's faces, 0.1 m from its center, which is rho
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
  CHECK(value(h, "min_singular_value") == doctest::Approx(2));
  CHECK(value(h, "isotropy") == doctest::Approx(2 / std::sqrt(6.0)));
  CHECK(value(h, "ellipsoid_volume") == doctest::Approx(std::pow(6, 1.5) * std::pow(4, 1.5)));
  CHECK(value(h, "centroid_distance") < 1e-12);
  CHECK(value(h, "epsilon") > 0);
}

TEST_CASE("a square of fingers has its area and no irregularity, at any position") {
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

TEST_CASE("friction holds the weight: two fingers press with weight over 2 mu each") {
  Held h = held(pinch(0.5, 0.01));
  const double weight = 9.81 * h.world.body(h.grasp.object).mass;
  CHECK(value(h, "gravity_effort") == doctest::Approx(weight / 0.5).epsilon(1e-7));
  // along the line of the fingers no friction is required
  const Pose up = Pose::turn(std::numbers::pi / 2, Vector3d::UnitY());
  Held upright = held(pinch(0, 0), up);
  CHECK(value(upright, "gravity_effort") == doctest::Approx(weight).epsilon(1e-7));
  Held slippery = held(pinch(0, 0));
  CHECK(value(slippery, "gravity_effort") == std::numeric_limits<double>::infinity());
}

TEST_CASE("a grasp without contacts has the worst value of every measure") {
  Held h = held({});
  for (const char* name :
       {"epsilon", "volume", "min_singular_value", "ellipsoid_volume", "isotropy", "polygon_area",
        "hand_min_singular_value", "manipulability", "hand_isotropy", "contact_robustness",
        "grasp_robustness", "penetration"})
    CHECK_MESSAGE(value(h, name) == 0, name);
  CHECK(value(h, "polygon_irregularity") == 1);
  CHECK(value(h, "centroid_distance") == std::numeric_limits<double>::infinity());
  CHECK(value(h, "joint_margin") == std::numeric_limits<double>::infinity());
}

TEST_CASE("positions of DOFs in their ranges: the middle is best, a limit worst") {
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

TEST_CASE("no measure changes when the complete scene is moved") {
  Random random(4);
  for (int round = 0; round < 3; ++round) {
    const auto points = around_ball(6, 0.6, 10 + round, round == 2 ? 0.01 : 0);
    Held here = held(points);
    Held there = held(points, {Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {1, 2, 3}});
    for (const Measure& measure : measures()) {
      // gravity is fixed in the world: the weight pulls in another direction
      if (measure.name == "gravity_effort" || measure.name.ends_with("robustness")) continue;
      const double a = value(here, measure.name), b = value(there, measure.name);
      // infinite values must be exactly equal
      const bool same = a == b || a == doctest::Approx(b).epsilon(1e-9);
      CHECK_MESSAGE(same, measure.name);
    }
  }
}

TEST_CASE("soft fingers hold more than point contacts") {
  Held hard = held(pinch(0.5)), soft = held(pinch(0.5, 0.02));
  CHECK(value(hard, "min_singular_value") == 0);
  CHECK(value(soft, "min_singular_value") > 0);
  CHECK(value(hard, "contact_robustness") == 0);
  CHECK(value(soft, "grasp_robustness") >= value(soft, "contact_robustness"));
}

TEST_CASE("measures have different names, and each has a range, a unit and a source") {
  std::set<std::string_view> names;
  for (const Measure& m : measures()) {
    CHECK(names.insert(m.name).second);
    for (const auto text : {m.what, m.range, m.unit, m.source}) CHECK_FALSE(text.empty());
  }
  CHECK_THROWS_WITH_AS(find_measure("epsilom"),
                       "unknown measure 'epsilom'; did you mean 'epsilon'?", Error);
}

TEST_CASE("duplicated contacts change neither the polygon nor its centroid") {
  const std::vector<Vector3d> once = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Vector3d> twice = once;
  twice.push_back(once[1]), twice.push_back(once[1]);
  const ContactPolygon a = contact_polygon(once), b = contact_polygon(twice);
  CHECK(a.centroid == b.centroid);
  CHECK(a.area == b.area);
}

namespace {

// a rod along x and a hand with a given approach direction, both turned
Held before_rod(const Vector3d& size, const Vector3d& approach, const Pose& X_WO) {
  Held h = six_fingers(0.5);
  h.grasp.object =
      h.world.add_body(body_spec("rod", box(size.x(), size.y(), size.z())), BodyKind::object, X_WO);
  RobotSpec hand;
  hand.name = "comer";
  hand.base = body_spec("comer_base", box(0.01, 0.01, 0.01));
  hand.X_BA = approach_frame(Vector3d::Zero(), approach);
  h.grasp.hand = h.world.add_robot(hand, {X_WO.rotation, {5, 5, 5}});
  return h;
}

}  // namespace

TEST_CASE("hands along or across an object's axis are orthogonal, and to a cube they are not") {
  const Pose poses[] = {Pose(), {Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {1, 2, 3}}};
  const double quarter = std::numbers::pi / 4;
  for (const Pose& X : poses)
    for (const double angle : {0.0, 0.3, quarter, 1.2, 2 * quarter, 2.8}) {
      const Vector3d approach(std::cos(angle), 0.6 * std::sin(angle), 0.8 * std::sin(angle));
      const double folded = std::abs(angle - 2 * quarter * std::round(angle / (2 * quarter)));
      // a rod, whose own axis has the least moment, and a plate, whose normal has the largest
      Held rod = before_rod({0.3, 0.02, 0.025}, approach, X);
      CHECK(value(rod, "orthogonality") == doctest::Approx(folded).epsilon(1e-9));
      Held plate = before_rod({0.01, 0.2, 0.21}, approach, X);
      CHECK(value(plate, "orthogonality") == doctest::Approx(folded).epsilon(1e-9));
      Held cube = before_rod({0.1, 0.1, 0.1}, approach, X);
      CHECK(value(cube, "orthogonality") == std::numeric_limits<double>::infinity());
    }
}

TEST_CASE(
    "normals in one plane are coplanar, and those of a cube's faces have the lowest coplanarity") {
  const auto fan = [](double lean, int count, bool twice) {
    std::vector<PointContact> points;
    for (int i = 0; i < count; ++i) {
      const double a = 2 * std::numbers::pi * i / count;
      const Vector3d out(std::cos(lean) * std::cos(a), std::cos(lean) * std::sin(a),
                         std::sin(lean));
      points.push_back(contact_at(0.05 * out, -out, 0.5));
    }
    if (twice) points.insert(points.end(), 3, points[0]);
    return held(points, {Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {1, 2, 3}});
  };
  Held flat = fan(0, 5, false), two = held(pinch(0.5)), cube = six_fingers(0.5);
  CHECK(value(flat, "coplanarity") < 1e-8);
  CHECK(value(two, "coplanarity") < 1e-8);
  CHECK(value(cube, "coplanarity") == doctest::Approx(std::sqrt(1.0 / 3)));
  // all leave the plane by one angle
  for (const double lean : {0.05, 0.3}) {
    Held leaning = fan(lean, 4, false), twice = fan(lean, 4, true);
    CHECK(value(leaning, "coplanarity") == doctest::Approx(std::sin(lean)));
    CHECK(value(twice, "coplanarity") == doctest::Approx(std::sin(lean)));
  }
  Held nothing = held({});
  CHECK(value(nothing, "coplanarity") == std::numeric_limits<double>::infinity());
}

TEST_CASE("contacts displaced by less than the margin keep force closure") {
  Random random(21);
  int closed = 0;
  for (int round = 0; round < 20; ++round) {
    Held h = held(around_ball(round % 2 ? 5 : 8, 0.7, 100 + round, round % 3 ? 0 : 0.01));
    const double margin = value(h, "contact_position_tolerance"), rho = h.grasp.rho;
    CHECK(margin == doctest::Approx(value(h, "epsilon") * rho / std::hypot(1, 0.7)));
    closed += margin > 0;
    // the same grasp ten times as large has ten times the margin
    Held large = h;
    for (PointContact& c : large.grasp.points) c.p_O *= 10, c.torsion_radius *= 10;
    large.grasp.rho *= 10;
    CHECK(value(large, "contact_position_tolerance") == doctest::Approx(10 * margin).epsilon(1e-6));
    for (int trial = 0; trial < 20; ++trial) {
      Held off = h;
      for (PointContact& c : off.grasp.points)
        c.p_O += 0.999 * margin *
                 Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      CHECK((margin == 0 || value(off, "epsilon") > 0));
    }
  }
  CHECK(closed > 10);
}
