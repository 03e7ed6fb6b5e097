#include "clench/grasp/wrench/wrench_space.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <numbers>
#include <numeric>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/math/decompositions.h"
#include "grasp/wrench_sets.h"
#include "support/linear.h"
#include "support/measured.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

Wrenches random_wrenches(Random& random, int count, double size = 1) {
  Wrenches out(6, count);
  for (double& x : out.reshaped()) x = size * random.normal();
  return out;
}

Wrenches all_of(const WrenchSpace& space) {
  Eigen::Index count = 0;
  for (const UnitWrenches& contact : space.contacts()) count += contact.edges.cols();
  Wrenches out(6, count);
  Eigen::Index column = 0;
  for (const UnitWrenches& contact : space.contacts())
    for (const auto& one : contact.edges.colwise()) out.col(column++) = one;
  return out;
}

// Brute-force reference: every hyperplane through six of the points that has all others on one
// side.
// returns  the least offset; 0 if the origin is not strictly inside
double slow_epsilon(const Wrenches& points) {
  const int n = static_cast<int>(points.cols());
  double least = std::numeric_limits<double>::infinity();
  std::vector<char> chosen(n, 0);
  std::fill(chosen.begin(), chosen.begin() + std::min(6, n), 1);
  do {
    Eigen::MatrixXd across(5, 6);
    int first = -1, row = 0;
    for (int i = 0; i < n; ++i) {
      if (!chosen[i]) continue;
      if (first < 0)
        first = i;
      else
        across.row(row++) = (points.col(i) - points.col(first)).transpose();
    }
    const auto across_all = common_normal(across);
    if (!across_all) continue;
    const Vector6d normal = *across_all;
    const double offset = normal.dot(points.col(first));
    const Eigen::RowVectorXd beyond = (normal.transpose() * points).array() - offset;
    // points on the plane deviate from it by rounding only
    if (beyond.maxCoeff() <= 1e-9) least = std::min(least, offset);
    if (beyond.minCoeff() >= -1e-9) least = std::min(least, -offset);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return std::isfinite(least) && least > 1e-9 ? least : 0;
}

// properties of every wrench space
void check_sound_cheaply(const WrenchSpace& space) {
  const Wrenches all = all_of(space);
  const double size = all.size() > 0 ? all.colwise().norm().maxCoeff() : 0;
  CHECK(space.rank() >= 0);
  CHECK(space.rank() <= 6);
  CHECK(space.epsilon() >= 0);
  CHECK(space.epsilon() <= size);
  CHECK(space.is_force_closure() == (space.epsilon() > 0));
  CHECK(space.weakest().direction.norm() == doctest::Approx(1).epsilon(1e-12));
  // the resistance equals the maximal wrench of the contacts against the weakest direction
  const Vector6d answer = -space.weakest().direction;
  const double reach = all.cols() > 0 ? (answer.transpose() * all).maxCoeff() : 0;
  if (space.rank() == 6) {
    CHECK(std::abs(reach - space.weakest().resistance) <= 1e-10 * size);
  } else {
    CHECK(space.epsilon() == 0);
    CHECK(space.weakest().resistance == 0);
    CHECK(std::abs(reach) <= 1e-9 * size);
  }
  if (space.is_force_closure()) {
    CHECK(space.epsilon() == space.weakest().resistance);
    CHECK(!space.weakest().contacts.empty());
  }
}

// additional properties of each facet
void check_sound(const WrenchSpace& space) {
  check_sound_cheaply(space);
  const Wrenches all = all_of(space);
  const double size = all.size() > 0 ? all.colwise().norm().maxCoeff() : 0;
  if (space.is_force_closure()) CHECK(space.volume() > 0);
  if (space.rank() < 6) CHECK(space.volume() == 0);
  // no point is beyond a facet
  const Hull hull = space.hull();
  for (int f = 0; f < hull.normals.cols(); ++f)
    CHECK((hull.normals.col(f).transpose() * all).maxCoeff() <= hull.offsets[f] + 1e-10 * size);
}

Wrenches cross_polytope() {
  Wrenches w(6, 12);
  w << Eigen::Matrix<double, 6, 6>::Identity(), -Eigen::Matrix<double, 6, 6>::Identity();
  return w;
}

// contacts around a ball of the given radius
std::vector<Wrenches> ball_grasp(const std::vector<Vector3d>& directions, double mu, int edges,
                                 double radius = 1) {
  std::vector<Wrenches> out;
  for (const Vector3d& d : directions) {
    const Vector3d u = d.normalized();
    out.push_back(
        cone_wrenches({.p_O = radius * u, .n_O = -u, .mu = mu}, {.edges = edges, .rho = radius}));
  }
  return out;
}

const std::vector<Vector3d> tetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

std::vector<Wrenches> contacts_of(const nlohmann::json& measured) {
  std::vector<Wrenches> out;
  for (const auto& c : measured["grasp_contact_list"]) {
    const auto& list = c["wrenches_fx_fy_fz_tx_ty_tz"];
    Wrenches w(6, list.size());
    for (size_t k = 0; k < list.size(); ++k)
      for (int row = 0; row < 6; ++row) w(row, k) = list[k][row].get<double>();
    out.push_back(w);
  }
  return out;
}

// contacts of the original, in units of its torque scale
std::vector<PointContact> points_of(const nlohmann::json& measured) {
  std::vector<PointContact> out;
  const auto vector = [](const nlohmann::json& x) {
    return Vector3d(x[0].get<double>(), x[1].get<double>(), x[2].get<double>());
  };
  const Vector3d com = vector(measured["gws_cog"]);
  for (const auto& c : measured["grasp_contact_list"])
    out.push_back({.p_O = (vector(c["pos_body1"]) - com) / measured["gws_max_radius"].get<double>(),
                   .n_O = vector(c["normal_body1"]),
                   .mu = c["cof"].get<double>()});
  return out;
}

}  // namespace

TEST_CASE("opposed unit pushes along all six axes: epsilon 1/sqrt 6, volume 2^6/6!") {
  const WrenchSpace space({cross_polytope()});
  CHECK(space.rank() == 6);
  CHECK(space.epsilon() == doctest::Approx(1 / std::sqrt(6.0)).epsilon(1e-12));
  CHECK(space.volume() == doctest::Approx(64.0 / 720).epsilon(1e-12));
  // the weakest wrench has equal components along all six axes
  CHECK((space.weakest().direction.cwiseAbs().array() - 1 / std::sqrt(6.0)).abs().maxCoeff() <
        1e-12);
  check_sound(space);
}

TEST_CASE("a cube of wrenches: epsilon is half its side") {
  Wrenches corners(6, 64);
  for (int i = 0; i < 64; ++i)
    for (int row = 0; row < 6; ++row) corners(row, i) = (i >> row & 1) ? 0.7 : -0.7;
  const WrenchSpace space({corners});
  CHECK(space.epsilon() == doctest::Approx(0.7).epsilon(1e-12));
  CHECK(space.volume() == doctest::Approx(std::pow(1.4, 6)).epsilon(1e-12));
  check_sound(space);
}

TEST_CASE("axes pushed with different strength: epsilon is the distance of a plane") {
  Wrenches w = cross_polytope();
  double sum = 0;
  for (int i = 0; i < 6; ++i) {
    w.col(i) *= 1 + i, w.col(i + 6) *= 1 + i;
    sum += 1.0 / ((1 + i) * (1 + i));
  }
  const WrenchSpace space({w});
  CHECK(space.epsilon() == doctest::Approx(1 / std::sqrt(sum)).epsilon(1e-12));
  CHECK(space.volume() == doctest::Approx(64.0).epsilon(1e-12));  // 2^6 6! / 6!
}

TEST_CASE("the original's wrench sets give the exact hull's epsilon and volume") {
  REQUIRE_SHARED();
  int compared = 0;
  const auto sets = test::measured("gws_exact_check");
  for (const auto& [name, exact] : sets.items()) {
    // for other sets no wrenches are recorded
    if (!std::filesystem::exists(shared() / "reference" / ("autograsp_" + name + ".json")))
      continue;
    CAPTURE(name);
    const WrenchSpace space(contacts_of(test::measured("autograsp_" + name)));
    const auto& expected = exact["Qt_no_joggle"];
    // -1 in these data means no force closure
    CHECK(std::abs(space.epsilon() - std::max(0.0, expected["epsilon"].get<double>())) < 1e-9);
    CHECK(std::abs(space.volume() - expected["volume"].get<double>()) < 1e-9);
    // without force closure, the distance of the hull from the origin is at least that of each of
    // its planes
    const double offset = expected["min_offset"].get<double>();
    if (space.is_force_closure())
      CHECK(std::abs(space.weakest().resistance - offset) < 1e-9);
    else
      CHECK(space.weakest().resistance <= offset + 1e-9);
    CHECK(space.rank() == 6);
    check_sound(space);
    ++compared;
  }
  CHECK(compared == 3);
}

TEST_CASE("real contacts, made soft, agree with the exact hull, up to 25 of them") {
  REQUIRE_SHARED();
  std::vector<std::vector<PointContact>> grasps;
  for (const std::string name : {"dlr_flask", "barrett_flask_bestSA", "plannerMug"})
    grasps.push_back(points_of(test::measured("autograsp_" + name)));
  // three rotated copies of one hand, and a finger of another
  const Eigen::Vector3d z = Vector3d::UnitZ();
  std::vector<PointContact> many = {grasps[1][0]};
  for (int i = 0; i < 3; ++i)
    for (PointContact c : grasps[0]) {
      const Eigen::AngleAxisd turn(2 * std::numbers::pi * i / 3, z);
      c.p_O = turn * c.p_O, c.n_O = turn * c.n_O;
      many.push_back(c);
    }
  REQUIRE(many.size() == 25);
  grasps.push_back(many);
  int closed = 0;
  for (std::vector<PointContact>& grasp : grasps) {
    // patches of some millimeters; rho is 1
    for (size_t i = 0; i < grasp.size(); ++i)
      grasp[i].torsion_radius = 0.01 * static_cast<double>(1 + i % 4);
    const WrenchSpace space(wrenches_of(grasp, grasp.size() > 10 ? 4 : 8));
    const Hull hull = space.hull();
    REQUIRE(hull.full());
    CHECK(std::abs(space.epsilon() - std::max(0.0, hull.offsets.minCoeff())) < 1e-9);
    CHECK(std::abs(space.volume() - hull.volume) < 1e-9);
    CHECK(space.is_force_closure() == (hull.offsets.minCoeff() > 1e-12));
    // the soft contacts contain the hard ones
    for (PointContact& c : grasp) c.torsion_radius = 0;
    CHECK(space.epsilon() >=
          WrenchSpace(wrenches_of(grasp, grasp.size() > 10 ? 4 : 8)).epsilon() - 1e-12);
    closed += space.is_force_closure();
  }
  CHECK(closed >= 3);
}

TEST_CASE("epsilon of few wrenches agrees with all hyperplanes through six of them") {
  Random random(1);
  int closed = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Wrenches w = random_wrenches(random, 7 + trial % 6);
    // seven random points seldom surround the origin: move their mean there
    if (trial % 3 != 0) w.colwise() -= w.rowwise().mean().eval();
    const WrenchSpace space({w});
    CHECK(space.epsilon() == doctest::Approx(slow_epsilon(w)).epsilon(1e-9));
    closed += space.is_force_closure();
    check_sound(space);
  }
  CHECK(closed > 30);
  CHECK(slow_epsilon(cross_polytope()) == doctest::Approx(1 / std::sqrt(6.0)).epsilon(1e-12));
}

TEST_CASE("epsilon of frictional grasps agrees with all hyperplanes through six wrenches") {
  Random random(2);
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<Vector3d> directions;
    for (int i = 0; i < 4; ++i)
      directions.push_back(trial == 0
                               ? tetrahedron[i]
                               : Vector3d(random.normal(), random.normal(), random.normal()));
    const WrenchSpace space(ball_grasp(directions, 0.8, 3));
    CHECK(space.epsilon() == doctest::Approx(slow_epsilon(all_of(space))).epsilon(1e-9));
  }
}

TEST_CASE("turning, permuting, repeating and regrouping wrenches changes nothing") {
  Random random(3);
  for (int trial = 0; trial < 5; ++trial) {
    const WrenchSpace space(ball_grasp(tetrahedron, 0.2 + 0.2 * trial, 8));
    const Wrenches all = all_of(space);
    // rounding of 6 x 6 rotations and of qhull's planes
    const auto same = [&](const Wrenches& w) {
      const WrenchSpace other({w});
      CHECK(std::abs(other.epsilon() - space.epsilon()) < 1e-12);
      CHECK(std::abs(other.volume() - space.volume()) < 1e-12);
      CHECK(other.rank() == space.rank());
    };
    same(random_turn(6, random) * all);
    std::vector<int> order(all.cols());
    std::iota(order.begin(), order.end(), 0);
    for (size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[random.bits() % (i + 1)]);
    same(all(Eigen::all, order));
    Wrenches twice(6, 2 * all.cols() + 1);
    twice << all, Vector6d::Zero(), all;
    if (space.is_force_closure()) same(twice);
    Wrenches inner(6, 2 * all.cols());
    inner << all, 0.5 * all;
    if (space.is_force_closure()) same(inner);
  }
}

TEST_CASE("epsilon scales with the wrenches, over all magnitudes") {
  const WrenchSpace one({cross_polytope()});
  for (const double scale : {1e-300, 1e-100, 1e-9, 1e9, 1e100, 1e300}) {
    const WrenchSpace space({scale * cross_polytope()});
    CHECK(space.rank() == 6);
    CHECK(space.epsilon() == doctest::Approx(scale * one.epsilon()).epsilon(1e-12));
    CHECK(space.is_force_closure());
  }
  // denormal numbers, which have reduced precision
  const WrenchSpace tiny({std::numeric_limits<double>::denorm_min() * cross_polytope()});
  CHECK(tiny.rank() == 6);
}

TEST_CASE(
    "spaces of no contact, no wrench, one wrench or zero wrenches resist nothing, without an "
    "error") {
  for (const auto& contacts : std::vector<std::vector<Wrenches>>{
           {}, {Wrenches(6, 0)}, {Wrenches::Zero(6, 1)}, {Wrenches::Zero(6, 40), Wrenches(6, 0)}}) {
    const WrenchSpace space(contacts);
    CHECK(space.rank() == 0);
    check_sound(space);
  }
  const WrenchSpace one({Wrenches(Vector6d(Vector6d::Ones()))});
  CHECK(one.rank() == 1);
  check_sound(one);
}

TEST_CASE(
    "sets below rank six report their rank, and the weakest direction is one that they do not "
    "span") {
  Random random(4);
  for (int rank = 1; rank <= 5; ++rank)
    for (int trial = 0; trial < 40; ++trial) {
      const int count = rank + trial;
      const Eigen::MatrixXd basis = random_turn(6, random).leftCols(rank);
      Eigen::MatrixXd mix(rank, count);
      for (double& x : mix.reshaped()) x = random.normal();
      const WrenchSpace space({Wrenches(basis * mix)});
      CHECK(space.rank() == rank);
      CHECK(space.weakest().resistance == 0);
      CHECK((basis.transpose() * space.weakest().direction).norm() < 1e-9);
      check_sound(space);
    }
}

TEST_CASE("two hard fingers cannot turn the object about their common line") {
  const WrenchSpace space(ball_grasp({{1, 0, 0}, {-1, 0, 0}}, 0.5, 8));
  CHECK(space.rank() == 5);
  CHECK(space.epsilon() == 0);
  CHECK(!space.is_force_closure());
  CHECK((space.weakest().direction - Vector6d::Unit(3)).norm() < 1e-12);
}

TEST_CASE(
    "the weakest wrench is an external one: a finger below cannot hold a load that pulls up") {
  // all pushes have an upward component, and there are both signs in every other direction
  Wrenches w(6, 11);
  w.col(0) = Vector6d::Unit(2);
  int column = 1;
  for (const int axis : {0, 1, 3, 4, 5})
    for (const double side : {-1, 1})
      w.col(column++) = Vector6d::Unit(2) + side * Vector6d::Unit(axis);
  const WrenchSpace space({w});
  CHECK(space.rank() == 6);
  CHECK(space.hull().rank == 5);  // all in the plane fz = 1
  CHECK(space.epsilon() == 0);
  CHECK((space.weakest().direction - Vector6d::Unit(2)).norm() < 1e-9);
  CHECK(space.weakest().resistance == doctest::Approx(-1));
  check_sound(space);

  // one shorter wrench: a full hull, but all wrenches still push upwards
  w.col(0) *= 0.5;
  const WrenchSpace full({w});
  CHECK(full.hull().full());
  CHECK(full.epsilon() == 0);
  CHECK(full.volume() > 0);
  CHECK(full.weakest().resistance < 0);
  check_sound(full);

  // held from above by a weaker finger: pulling up is resisted, but least of all directions
  Wrenches held(6, 12);
  held << 10 * cross_polytope();
  held.col(8) = -0.1 * Vector6d::Unit(2);
  const WrenchSpace weak({held});
  CHECK(weak.is_force_closure());
  CHECK(weak.weakest().direction[2] > 0.99);
  CHECK(weak.weakest().resistance < 0.1);
  check_sound(weak);
}

// distance of a hull from the origin, by steps towards the wrench most opposed to the current point
double slow_distance(const Wrenches& points) {
  Vector6d at = points.col(0);
  for (int step = 0; step < 200000; ++step) {
    int next = 0;
    (at.transpose() * points).minCoeff(&next);
    const Vector6d way = points.col(next) - at;
    const double square = way.squaredNorm(), part = -way.dot(at) / square;
    if (square == 0 || part <= 0) break;
    at += std::min(part, 1.0) * way;
  }
  return at.norm();
}

TEST_CASE(
    "without force closure the weakest wrench points away from the nearest point of the hull") {
  Random random(21);
  int outside = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<PointContact> contacts(3 + trial % 3);
    for (PointContact& c : contacts) {
      c = random_contact(random, 0.5);
      c.n_O = Vector3d(c.n_O.x(), c.n_O.y(), std::abs(c.n_O.z()) + 0.6).normalized();
      if (trial % 2) c.torsion_radius = 0.1;
    }
    const WrenchSpace space(wrenches_of(contacts, 8));
    REQUIRE(!space.is_force_closure());
    const double distance = slow_distance(all_of(space));
    if (distance < 1e-3) continue;
    ++outside;
    // the error decreases with the inverse of the number of steps
    CHECK(space.weakest().resistance == doctest::Approx(-distance).epsilon(1e-3));
    CHECK(space.weakest().resistance >= -distance - 1e-9);
    check_sound_cheaply(space);
    // in L-infinity each contact may have zero force, so the resistance is 0
    const WrenchSpace each(wrenches_of(contacts, 8), {.norm = WrenchNorm::linf});
    CHECK((each.weakest().direction - space.weakest().direction).norm() < 1e-6);
    CHECK(each.weakest().resistance == 0);
    CHECK(each.weakest().contacts.empty());
  }
  CHECK(outside >= 10);
}

TEST_CASE("an origin on the boundary is not inside: epsilon is exactly 0") {
  // half a cross polytope, with the origin as one of its points or on its face
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Wrenches half(6, 12);
    half << cross_polytope();
    half.col(6 + trial % 6) =
        trial % 2 ? Vector6d::Zero().eval() : Vector6d(0.3 * Vector6d::Unit((trial + 1) % 6));
    const WrenchSpace space({trial < 12 ? half : Wrenches(random_turn(6, random) * half)});
    CHECK(space.rank() == 6);
    CHECK(space.epsilon() == 0);
    check_sound(space);
  }
}

TEST_CASE(
    "without friction a ball cannot be kept from turning, and with friction four fingers hold it") {
  CHECK(WrenchSpace(ball_grasp(tetrahedron, 0, 8)).rank() == 3);
  double last = 0;
  for (const double mu : {0.1, 0.3, 1.0, 3.0}) {
    const WrenchSpace space(ball_grasp(tetrahedron, mu, 8));
    CHECK(space.is_force_closure());
    CHECK(space.epsilon() > last);  // more friction, more resistance
    last = space.epsilon();
    check_sound(space);
  }
}

TEST_CASE("a grasp twice the size has the same wrench space") {
  const WrenchSpace small(ball_grasp(tetrahedron, 0.5, 8, 0.01)),
      large(ball_grasp(tetrahedron, 0.5, 8, 2));
  CHECK(std::abs(small.epsilon() - large.epsilon()) < 1e-12);
  CHECK(std::abs(small.volume() - large.volume()) < 1e-12);
}

TEST_CASE("symmetric grasps with any number of fingers and edges never fail") {
  for (int fingers = 1; fingers <= 6; ++fingers)
    for (const int edges : {3, 4, 8})
      for (const double mu : {0.0, 1e-9, 1e-6, 0.5, 1.0, 100.0}) {
        std::vector<Vector3d> ring;
        for (int i = 0; i < fingers; ++i) {
          const double angle = 2 * std::numbers::pi * i / fingers;
          ring.emplace_back(std::cos(angle), std::sin(angle), 0);
        }
        check_sound(WrenchSpace(ball_grasp(ring, mu, edges)));
      }
}

TEST_CASE("structured sets never fail: lattices, repeats, near repeats, thin sets, mixed sizes") {
  Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const int count = 1 + static_cast<int>(random.bits() % 40);
    Wrenches w = random_wrenches(random, count);
    const int kind = trial % 6;
    if (kind == 0) w = w.array().round();                           // points of a lattice
    if (kind == 1) w = w.array().sign();                            // corners of a cube
    if (kind == 2) w.rightCols(count / 2) = w.leftCols(count / 2);  // repeated
    if (kind == 3)                                                  // nearly repeated
      w.rightCols(count / 2) = w.leftCols(count / 2) + random_wrenches(random, count / 2, 1e-13);
    if (kind == 4) w.row(trial / 6 % 6) *= std::pow(10, -random.uniform(0, 16));  // thin
    if (kind == 5)                                                                // of many sizes
      for (int i = 0; i < count; ++i) w.col(i) *= std::pow(10, -random.uniform(0, 16));
    CAPTURE(trial);
    check_sound(WrenchSpace({w}));
  }
}

TEST_CASE("a number that is not finite is rejected with its place") {
  Wrenches good = cross_polytope(), bad = good;
  bad(3, 4) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(WrenchSpace({good, bad}),
                       "wrench space: contact 2, wrench 5: numbers must be finite, got nan", Error);
  bad(3, 4) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(WrenchSpace({bad}),
                       "wrench space: contact 1, wrench 5: numbers must be finite, got inf", Error);
}

// --- norms, round cones, soft fingers, brackets ---

namespace {

std::vector<UnitWrenches> cones(const std::vector<PointContact>& contacts, int edges) {
  std::vector<UnitWrenches> out;
  for (const PointContact& c : contacts) out.push_back(unit_wrenches(c, {.edges = edges}));
  return out;
}

// all sums of at most one wrench per contact
Wrenches enumerated(const std::vector<Wrenches>& contacts) {
  Wrenches sums = Wrenches::Zero(6, 1);
  for (const Wrenches& w : contacts) {
    Wrenches next(6, sums.cols() * (w.cols() + 1));
    next.leftCols(sums.cols()) = sums;
    for (int k = 0; k < w.cols(); ++k)
      next.middleCols((k + 1) * sums.cols(), sums.cols()) = sums.colwise() + w.col(k);
    sums = next;
  }
  return sums;
}

std::vector<PointContact> soft_pinch(double torsion_radius) {
  std::vector<PointContact> out = ball_contacts({{1, 0, 0}, {-1, 0, 0}}, 0.5);
  for (PointContact& c : out) c.torsion_radius = torsion_radius;
  return out;
}

}  // namespace

TEST_CASE("L-infinity has the epsilon and volume of an enumeration of all sums") {
  Random random(11);
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<PointContact> contacts(3);
    for (PointContact& c : contacts) c = random_contact(random, 0.8);
    if (trial < 3) contacts = ball_contacts(ring_directions(3), 0.3 + 0.2 * trial);
    const auto set = wrenches_of(contacts, 3 + trial % 2);
    const WrenchSpace sums(set, {.norm = WrenchNorm::linf});
    const WrenchSpace all({enumerated(set)});
    CHECK(std::abs(sums.epsilon() - all.epsilon()) < 1e-11);
    CHECK(sums.is_force_closure() == WrenchSpace(set).is_force_closure());
    CHECK(sums.epsilon() >= WrenchSpace(set).epsilon());
    CHECK(sums.volume() == doctest::Approx(all.volume()).epsilon(1e-9));
  }
}

TEST_CASE(
    "without friction the L-infinity space is a zonotope, whose volume is a sum over sets of six "
    "wrenches") {
  Random random(12);
  for (int trial = 0; trial < 5; ++trial) {
    const int count = 7 + trial % 3;
    std::vector<Wrenches> contacts;
    for (int i = 0; i < count; ++i) contacts.push_back(random_wrenches(random, 1));
    double sum = 0;
    std::vector<char> chosen(count, 0);
    std::fill(chosen.begin(), chosen.begin() + 6, 1);
    do {
      Eigen::MatrixXd six(6, 6);
      int column = 0;
      for (int i = 0; i < count; ++i)
        if (chosen[i]) six.col(column++) = contacts[i];
      sum += singular_value_decomposition(six).values.prod();
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    CHECK(WrenchSpace(contacts, {.norm = WrenchNorm::linf}).volume() ==
          doctest::Approx(sum).epsilon(1e-9));
  }
}

TEST_CASE("round cones contain every pyramid, and are the limit of many edges") {
  Random random(13);
  for (int trial = 0; trial < 10; ++trial)
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
      std::vector<PointContact> contacts(4);
      for (PointContact& c : contacts) c = random_contact(random, 0.9);
      if (trial == 0) contacts = ball_contacts(solid_directions(4), 0.5);
      const WrenchSpace round(cones(contacts, round_edges), {.norm = norm});
      const EpsilonBounds bounds = round.epsilon_bounds({.tolerance = 1e-7});
      CHECK(bounds.converged);
      CHECK(bounds.upper - bounds.lower <= 1e-7);
      CHECK(round.epsilon() >= bounds.lower);
      CHECK(round.epsilon() <= bounds.upper);
      for (const int edges : {3, 8, 64, 512}) {
        const double epsilon = WrenchSpace(cones(contacts, edges), {.norm = norm}).epsilon();
        CHECK(epsilon <= round.epsilon() + 1e-9);
        // a pyramid of n edges contains the cone shrunk by cos(pi / n)
        if (edges == 512) CHECK(epsilon > round.epsilon() - 1e-3);
      }
    }
}

TEST_CASE("a bracket narrows with its tolerance, and at_least stops the computation early") {
  const WrenchSpace space(cones(ball_contacts(solid_directions(6), 0.6), round_edges));
  for (const double tolerance : {1e-1, 1e-3, 1e-5, 1e-8}) {
    const EpsilonBounds bounds = space.epsilon_bounds({.tolerance = tolerance});
    CHECK(bounds.converged);
    CHECK(bounds.upper - bounds.lower <= tolerance);
  }
  const double epsilon = space.epsilon();
  for (const double part : {-1.0, 0.5, 0.99, 1.01, 2.0}) {
    const WrenchSpace fresh(cones(ball_contacts(solid_directions(6), 0.6), round_edges));
    const EpsilonBounds bounds =
        fresh.epsilon_bounds({.tolerance = 1e-9, .at_least = part * epsilon});
    CHECK(bounds.lower <= epsilon + 1e-12);
    CHECK(bounds.upper >= epsilon - 1e-9);
    CHECK((bounds.lower >= part * epsilon) == (part < 1));
    // and earlier queries do not matter
    CHECK(std::abs(fresh.epsilon() - epsilon) < 2e-9);
  }
  const WrenchSpace nothing(cones(ball_contacts({{1, 0, 0}}, 1), 8));
  CHECK(nothing.epsilon_bounds({.tolerance = 0}).upper == 0);
  CHECK_THROWS_WITH_AS(space.epsilon_bounds({.tolerance = -1}),
                       "wrench space: tolerance must be >= 0, got -1", Error);
  CHECK_THROWS_WITH_AS(space.epsilon_bounds({.at_least = std::numeric_limits<double>::infinity()}),
                       "wrench space: at_least must be finite, got inf", Error);
}

TEST_CASE("two soft fingers hold torques that two hard ones do not, and more with larger patches") {
  double last = 0;
  for (const double radius : {0.0, 0.01, 0.1, 0.5})
    for (const int edges : {8, round_edges}) {
      const WrenchSpace space(cones(soft_pinch(radius), edges));
      CHECK(space.rank() == (radius > 0 ? 6 : 5));
      CHECK(space.is_force_closure() == (radius > 0));
      if (edges == round_edges) continue;
      CHECK((radius == 0 || space.epsilon() > last));
      last = space.epsilon();
    }
  // both patches resist the rotation about the line: mu times the radius
  const WrenchSpace small(cones(soft_pinch(0.01), round_edges));
  CHECK(std::abs(small.epsilon() - 0.5 * 0.01) < 1e-6);
  CHECK(std::abs(small.weakest().direction[3]) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("the weakest direction names the contacts that yield first") {
  // strong fingers along x and y, weak ones along z
  std::vector<Wrenches> contacts;
  for (int axis = 0; axis < 6; ++axis)
    for (const double side : {1, -1})
      contacts.push_back(Wrenches((axis == 2 ? 0.1 : 1) * side * Vector6d::Unit(axis)));
  const WrenchSpace space(contacts);
  const Weakest& weakest = space.weakest();
  CHECK(std::abs(weakest.direction[2]) > 0.9);
  // one of each pair carries the facet
  CHECK(weakest.contacts.size() == 6);
  const WrenchSpace sums(contacts, {.norm = WrenchNorm::linf});
  CHECK(sums.epsilon() == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(sums.weakest().contacts.size() == 1);
  CHECK(sums.weakest().contacts[0] == (sums.weakest().direction[2] > 0 ? 5 : 4));
  CHECK(WrenchSpace({cross_polytope().leftCols(3)}).weakest().contacts.empty());
}

TEST_CASE("only the selected coordinates are evaluated") {
  Random random(14);
  const Wrenches all = random_wrenches(random, 30);
  for (const std::vector<int>& coordinates :
       std::vector<std::vector<int>>{{0, 1, 2}, {5, 2}, {3, 4, 5, 0}, {0, 1, 2, 3, 4}}) {
    const WrenchSpace space({all}, {.coordinates = coordinates});
    const Hull hull = convex_hull(Eigen::MatrixXd(all(coordinates, Eigen::all)));
    CHECK(space.dimension() == static_cast<int>(coordinates.size()));
    CHECK(space.rank() == space.dimension());
    CHECK(space.epsilon() ==
          doctest::Approx(std::max(0.0, hull.offsets.minCoeff())).epsilon(1e-12));
    CHECK(space.volume() == doctest::Approx(hull.volume).epsilon(1e-12));
    for (int c = 0; c < 6; ++c)
      if (std::find(coordinates.begin(), coordinates.end(), c) == coordinates.end())
        CHECK(space.weakest().direction[c] == 0);
  }
  const auto refuse = [&](std::vector<int> coordinates, const char* why) {
    CHECK_THROWS_WITH_AS(WrenchSpace({all}, {.coordinates = std::move(coordinates)}), why, Error);
  };
  refuse({0}, "wrench space: expected 2 to 6 coordinates, got 1");
  refuse({0, 6}, "wrench space: coordinates must be 0 to 5, got 6");
  refuse({0, 1, 0}, "wrench space: coordinate 0 is given twice");
}

TEST_CASE("size, position, rotation, order and duplicated contacts change no measure") {
  Random random(15);
  for (int trial = 0; trial < 12; ++trial) {
    const WrenchNorm norm = trial % 2 ? WrenchNorm::linf : WrenchNorm::l1;
    const int edges = trial % 4 < 2 ? 8 : round_edges;
    const bool round = edges == round_edges;
    // hard contacts, soft contacts, both kinds, and with a frictionless contact
    std::vector<PointContact> contacts(4);
    for (PointContact& c : contacts) c = random_contact(random, 0.8);
    if (trial % 3 == 0) contacts = ball_contacts(solid_directions(4), 0.5);
    for (size_t i = 0; i < contacts.size(); ++i)
      if (trial / 4 == 1 || (trial / 4 == 2 && i < 2)) contacts[i].torsion_radius = 0.1;
    if (trial >= 8) contacts.push_back({.p_O = {0, 0, -1}, .n_O = {0, 0, 1}, .mu = 0});
    CAPTURE(trial);

    struct Measured {
      double epsilon, volume;
      bool closes;
      size_t weakest;
    };
    const auto measure = [&](const std::vector<UnitWrenches>& cones) {
      const WrenchSpace space(cones, {.norm = norm});
      // hulls of L-infinity are large, and volumes of round cones are tested separately
      const double volume = norm == WrenchNorm::l1 && !round ? space.volume() : 0;
      return Measured{space.epsilon(), volume, space.is_force_closure(),
                      space.weakest().contacts.size()};
    };
    const auto cones_at = [&](const std::vector<PointContact>& at, const ConeOptions& options) {
      std::vector<UnitWrenches> out;
      for (const PointContact& c : at) out.push_back(unit_wrenches(c, options));
      return out;
    };
    const auto as_they_are = cones_at(contacts, {.edges = edges});
    const Measured one = measure(as_they_are);
    // round cones are accurate to 1e-9, sums of five contacts to five times 1e-12
    const double close = round ? 3e-9 : 1e-11;
    const auto same = [&](const std::vector<UnitWrenches>& cones, double times = 1) {
      const Measured other = measure(cones);
      CHECK(std::abs(other.epsilon - times * one.epsilon) < times * close);
      CHECK(std::abs(other.volume - one.volume) <= 1e-10 * one.volume);
      CHECK(other.closes == one.closes);
    };

    // another unit of length, with torques divided by the same length in it; another position of
    // all contacts
    for (const double size : {1e-3, 2.0, 1e3}) {
      const Vector3d at = size * random_unit_vector(random);
      std::vector<PointContact> other = contacts;
      for (PointContact& c : other) c.p_O = size * c.p_O + at, c.torsion_radius *= size;
      same(cones_at(other, {.edges = edges, .rho = size, .p_OM = at}));
    }
    // pyramids are rotated with their contacts, round cones are computed from rotated contacts
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized()
            .toRotationMatrix();
    std::vector<UnitWrenches> turned = as_they_are;
    for (UnitWrenches& c : turned)
      for (const int rows : {0, 3})
        c.edges.middleRows<3>(rows) = (turn * c.edges.middleRows<3>(rows)).eval();
    if (round) {
      std::vector<PointContact> other = contacts;
      for (PointContact& c : other) c.p_O = turn * c.p_O, c.n_O = (turn * c.n_O).normalized();
      turned = cones_at(other, {.edges = edges});
    }
    same(turned);
    std::vector<UnitWrenches> backwards(as_they_are.rbegin(), as_they_are.rend());
    same(backwards);
    std::rotate(backwards.begin(), backwards.begin() + 2, backwards.end());
    same(backwards);
    std::vector<UnitWrenches> doubled = as_they_are;
    doubled.insert(doubled.end(), backwards.begin(), backwards.end());
    same(doubled, norm == WrenchNorm::l1 ? 1 : 2);
  }
}

TEST_CASE("volumes of round cones lie in brackets that narrow with finer pyramids") {
  // forces of two opposed contacts: in L1 a cylinder
  const double mu = 0.6, pi = std::numbers::pi;
  const auto opposed = ball_contacts({{0, 0, 1}, {0, 0, -1}}, mu);
  const auto forces = [&](WrenchNorm norm, std::vector<int> coordinates, double torsion) {
    auto contacts = opposed;
    for (PointContact& c : contacts) c.torsion_radius = torsion;
    return WrenchSpace(cones(contacts, round_edges),
                       {.norm = norm, .coordinates = std::move(coordinates)});
  };
  const auto check = [](const WrenchSpace& space, double expected, double width) {
    double last = 1;
    for (const int edges : {4, 8, 32, 100}) {
      const VolumeBounds bounds = space.volume_bounds(edges);
      CHECK(bounds.lower < expected);
      CHECK(bounds.upper > expected);
      CHECK((bounds.upper - bounds.lower) / expected < 20 * last);
      last = (bounds.upper - bounds.lower) / expected;
    }
    CHECK(last < width);
    CHECK(space.volume() == (space.volume_bounds(32).lower + space.volume_bounds(32).upper) / 2);
    CHECK(space.volume() == doctest::Approx(expected).epsilon(0.06));
  };
  check(forces(WrenchNorm::l1, {0, 1, 2}, 0), 2 * pi * mu * mu, 2e-3);
  // in L-infinity the disc at height z has the radius (2 - |z|) mu
  check(forces(WrenchNorm::linf, {0, 1, 2}, 0), 14.0 / 3 * pi * mu * mu, 2e-3);
  // soft: an ellipsoid of forces across and torques about the normal
  check(forces(WrenchNorm::l1, {0, 1, 5}, 0.3), 4.0 / 3 * pi * mu * mu * mu * 0.3, 0.02);

  // six dimensions: bracketed by fine pyramids
  Random random(16);
  std::vector<PointContact> contacts(3);
  for (PointContact& c : contacts) c = random_contact(random, 0.8);
  contacts.push_back({.p_O = {0, 0, -1}, .n_O = {0, 0, 1}, .mu = 0});
  const WrenchSpace round(cones(contacts, round_edges));
  const VolumeBounds bounds = round.volume_bounds();
  for (const int edges : {8, 32}) {
    const double volume = WrenchSpace(cones(contacts, edges)).volume();
    CHECK(volume <= bounds.lower * (1 + 1e-9));
    if (edges == 32) CHECK(volume == doctest::Approx(bounds.lower).epsilon(1e-9));
  }
  CHECK(WrenchSpace(cones(contacts, 48)).volume() < bounds.upper);
  CHECK(round.volume_bounds(48).lower > bounds.lower);
  CHECK(round.volume_bounds(48).upper < bounds.upper);
  // pyramids have an exact volume, and so have flat spaces
  const WrenchSpace edged(cones(contacts, 8));
  CHECK(edged.volume_bounds().lower == edged.volume());
  CHECK(edged.volume_bounds().upper == edged.volume());
  CHECK(WrenchSpace(cones(opposed, round_edges)).volume_bounds().upper == 0);
  for (const int edges : {3, 1001})
    CHECK_THROWS_WITH_AS(
        round.volume_bounds(edges),
        fmt::format("wrench space: edges must be 4 to 1000, got {}", edges).c_str(), Error);
}

TEST_CASE("hulls that do not exist or are too large are rejected") {
  const WrenchSpace round(cones(ball_contacts(solid_directions(4), 0.5), round_edges));
  CHECK_THROWS_WITH_AS(round.hull(), "wrench space: no hull of points with round cones, give edges",
                       Error);
  const WrenchSpace sums(wrenches_of(ball_contacts(solid_directions(6), 0.5), 16),
                         {.norm = WrenchNorm::linf});
  CHECK_THROWS_WITH_AS(sums.hull(), "wrench space: no hull of points in L-infinity", Error);
  CHECK_THROWS_WITH_AS(
      sums.volume(),
      "wrench space: volume: in L-infinity the space of 6 contacts has more than 60000 cells; give "
      "fewer edges",
      Error);
  // a cyclic polytope of n corners has n (n - 4) (n - 5) / 6 facets
  Wrenches curve(6, 190);
  for (int i = 0; i < curve.cols(); ++i)
    for (int k = 0; k < 6; ++k) {
      const double angle = (k / 2 + 1) * 2 * std::numbers::pi * i / 190;
      curve(k, i) = k % 2 ? std::sin(angle) : std::cos(angle);
    }
  CHECK_THROWS_WITH_AS(WrenchSpace({curve}).volume(),
                       "wrench space: volume: the hull of 1 contact has more than 1000000 facets; "
                       "give fewer edges",
                       Error);
}

TEST_CASE("hard sets of every kind give a converged bracket, and L-infinity is at least L1") {
  for (int kind = 0; kind < wrench_set_kinds; ++kind)
    for (uint64_t number = 100; number < 160; ++number) {
      CAPTURE(wrench_set_kind(kind));
      CAPTURE(number);
      const auto set = wrench_set(kind, number);
      const WrenchSpace space(set);
      check_sound_cheaply(space);
      CHECK(space.epsilon_bounds({.tolerance = 1e-9}).converged);
      if (set.size() > 5 || number % 6 != 0) continue;
      const WrenchSpace sums(set, {.norm = WrenchNorm::linf});
      CHECK(sums.epsilon() >= space.epsilon() - 1e-9);
      CHECK(sums.epsilon_bounds({.tolerance = 1e-8}).converged);
    }
}
