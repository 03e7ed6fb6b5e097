#include "grasp/symmetry_cone.h"

#include "base/random.h"
#include "grasp/contact_reach.h"
#include "grasp/expanding_polytope.h"
#include "grasp/facet_complex.h"
#include "grasp/wrench_hull.h"
#include "grasp/wrench_sets.h"
#include "support/cases.h"

using namespace clench;
using namespace clench::test;

namespace {

DirectionCone cone_of(const Eigen::MatrixXd& points) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = points;
  const int count = static_cast<int>(points.cols());
  return symmetry_cone({static_cast<int>(points.rows()), count, count, rows.data(), {}});
}

ContactReach reach_of_points(const Eigen::MatrixXd& points) {
  const ContactPart part{.points = points.data(), .count = static_cast<int>(points.cols())};
  return ContactReach(static_cast<int>(points.rows()), WrenchNorm::l1, std::span(&part, 1));
}

bool contains(const DirectionCone& cone, const Eigen::VectorXd& direction) {
  for (int i = 0; i < cone.walls; ++i)
    if (Eigen::Map<const Eigen::VectorXd>(cone.wall[i], direction.size()).dot(direction) > 1e-9)
      return false;
  return true;
}

// coordinates permuted and mirrored at random: what carries a cube onto itself
Eigen::MatrixXd random_cube_symmetry(Random& random, int d) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(d, d);
  std::vector<int> axis(d);
  for (int i = 0; i < d; ++i) axis[i] = i;
  for (int i = d - 1; i > 0; --i) std::swap(axis[i], axis[pick(random, 0, i)]);
  for (int i = 0; i < d; ++i) out(axis[i], i) = pick(random, 0, 1) ? 1 : -1;
  return out;
}

Eigen::MatrixXd random_rotation(Random& random, int d) {
  Eigen::MatrixXd m(d, d);
  for (double& x : m.reshaped()) x = random.normal();
  // by Gram and Schmidt
  for (int k = 0; k < d; ++k) {
    for (int j = 0; j < k; ++j) m.col(k) -= m.col(j).dot(m.col(k)) * m.col(j);
    m.col(k).normalize();
  }
  return m;
}

// Random points and all that an isometry of finite order makes of them, turned; of size about one.
Eigen::MatrixXd symmetric_points(Random& random, int d) {
  const Eigen::MatrixXd g = random_cube_symmetry(random, d), h = random_cube_symmetry(random, d);
  const bool two = pick(random, 0, 1) == 1;
  std::vector<Eigen::VectorXd> points;
  const int seeds = pick(random, 1, 4);
  for (int i = 0; i < seeds; ++i) {
    Eigen::VectorXd p(d);
    for (double& x : p) x = random.normal() / 4;
    // some on the axes and in the mirrors
    if (pick(random, 0, 2) == 0) p[pick(random, 0, d - 1)] = 0;
    if (pick(random, 0, 2) == 0) p[0] = p[d - 1];
    points.push_back(p);
  }
  for (size_t i = 0; i < points.size() && points.size() < 80; ++i)
    for (const auto* m : {&g, &h}) {
      if (m == &h && !two) continue;
      const Eigen::VectorXd image = *m * points[i];
      bool there = false;
      for (const auto& p : points) there |= (p - image).norm() < 1e-12;
      if (!there) points.push_back(image);
    }
  Eigen::MatrixXd out(d, points.size());
  for (size_t i = 0; i < points.size(); ++i) out.col(i) = points[i];
  return random_rotation(random, d) * out;
}

}  // namespace

TEST_CASE("sets without symmetry need all directions") {
  Random random(1);
  for (int d = 2; d <= 6; ++d)
    for (int trial = 0; trial < 20; ++trial) {
      Eigen::MatrixXd points(d, d + 1 + trial);
      for (double& x : points.reshaped()) x = random.normal() / 4;
      CHECK(cone_of(points).walls == 0);
      // two points of one length alone exchange nothing
      points.col(1) *= points.col(0).norm() / points.col(1).norm();
      CHECK(cone_of(points).walls == 0);
    }
  CHECK(cone_of(Eigen::MatrixXd::Zero(6, 8)).walls == 0);
  CHECK(cone_of(Eigen::MatrixXd::Ones(6, 1)).walls == 0);
}

TEST_CASE("a cone of directions meets facets of each distance that the hull has") {
  Random random(2);
  int symmetric = 0, narrowed = 0;
  for (int trial = 0; trial < cases(300); ++trial) {
    const int d = pick(random, 2, 6);
    const Eigen::MatrixXd points = symmetric_points(random, d);
    const Hull hull = convex_hull(points);
    if (!hull.full()) continue;
    ++symmetric;
    const DirectionCone cone = cone_of(points);
    narrowed += cone.walls > 0;
    for (int i = 0; i < hull.offsets.size(); ++i) {
      bool met = false;
      for (int j = 0; j < hull.offsets.size(); ++j)
        met |= std::abs(hull.offsets[j] - hull.offsets[i]) < 1e-9 &&
               contains(cone, hull.normals.col(j));
      CHECK(met);
    }
  }
  CHECK(narrowed > symmetric / 2);
}

TEST_CASE("the ball inside a symmetric set is that of its whole hull") {
  Random random(3);
  int inside = 0;
  for (int trial = 0; trial < cases(1000); ++trial) {
    const int d = pick(random, 2, 6);
    Eigen::MatrixXd points = symmetric_points(random, d);
    // symmetric but for a little, or not at all any more
    const int kind = pick(random, 0, 4);
    if (kind == 4) {
      // still carried onto itself, but by no isometry
      const double shear = std::pow(10, -random.uniform(5, 13));
      points += (shear * random_rotation(random, d) * points).eval();
      points.row(0) += shear * points.row(d - 1);
    } else if (kind > 0)
      for (double& x : points.reshaped())
        x += std::pow(10, -random.uniform(8, 18)) * (kind == 1 ? 1 : random.uniform(-1, 1));
    if (kind == 3) points.conservativeResize(d, points.cols() - 1);
    if (points.cols() <= d) continue;
    const Hull hull = convex_hull(points);
    if (!hull.full() || hull.offsets.minCoeff() < 1e-6) continue;
    ++inside;
    const Ball ball = largest_ball(reach_of_points(points));
    CHECK(ball.end == BallEnd::inside);
    CHECK(std::abs(ball.upper - hull.offsets.minCoeff()) < 2e-12);
    CHECK(ball.upper - ball.lower <= 1e-12);
  }
  CHECK(inside > cases(1000) / 5);
}

TEST_CASE("a centre of mass beside the middle shears the wrenches, and no isometry carries them") {
  for (const int count : {4, 8})
    for (const double off : {1e-6, 1e-8, 1e-10}) {
      std::vector<Wrenches> contacts;
      for (const PointContact& contact : ball_contacts(solid_directions(count), 0.5))
        contacts.push_back(
            cone_wrenches(contact, {.edges = 8, .p_OM = {off, 0.3 * off, 0.5 * off}}));
      const Wrenches all = side_by_side(contacts) / 2;
      CHECK(cone_of(all).walls == 0);
      const Ball ball = largest_ball(reach_of_points(all));
      CHECK(std::abs(ball.upper - convex_hull(all).offsets.minCoeff()) < 1e-12);
    }
}

TEST_CASE("a wall is a mirror to rounding, wherever the mirror is") {
  // some are nearly through the centre of the cone, and make no wall
  Random random(5);
  int mirrors = 0;
  for (int i = 0; i < 2000; ++i) {
    const double angle = std::numbers::pi * i / 2000;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    Eigen::MatrixXd points(2, 8);
    for (double& x : points.reshaped()) x = random.uniform(-0.5, 0.5);
    for (int k = 0; k < 4; ++k)
      points.col(4 + k) = points.col(k) - 2 * normal.dot(points.col(k)) * normal;
    for (double& x : points.reshaped()) x += 1e-15 * random.uniform(-1, 1);
    const DirectionCone cone = cone_of(points);
    if (cone.walls == 0) continue;
    ++mirrors;
    const Eigen::Vector2d wall(cone.wall[0]);
    CHECK((normal.dot(wall) * normal - wall).norm() < 1e-12);
  }
  CHECK(mirrors > 1900);
}

TEST_CASE("in few dimensions walls leave each facet a corner that is not at infinity") {
  for (const int count : {32, 64, 128}) {
    Eigen::MatrixXd ring(2, count);
    const auto directions = ring_directions(count);
    for (int i = 0; i < count; ++i) ring.col(i) = directions[i].head<2>();
    CHECK(cone_of(ring).walls > 2);
    const Ball ball = largest_ball(reach_of_points(ring));
    CHECK(ball.end == BallEnd::inside);
    CHECK(std::abs(ball.upper - std::cos(std::numbers::pi / count)) < 1e-14);
    CHECK(ball.points < count * 2 / 3);
  }
}

TEST_CASE("what breaks with walls is searched as if there were none") {
  // breaks as soon as it is asked with a wall
  class Breaking final : public SupportSet {
   public:
    Breaking(const ContactReach& reach, bool breaks) : reach_(reach), breaks_(breaks) {}
    int dimension() const override { return reach_.dimension(); }
    double support(const double* direction, double* point) const override {
      if (std::exchange(walled_, false)) throw BrokenSurface();
      return reach_.support(direction, point);
    }
    DirectionCone least_support_cone() const override {
      walled_ = breaks_;
      return {.walls = breaks_, .wall = {{1}}};
    }

   private:
    const ContactReach& reach_;
    bool breaks_;
    mutable bool walled_ = false;
  };
  Random random(6);
  Eigen::MatrixXd points(6, 60);
  for (double& x : points.reshaped()) x = random.normal() / 4;
  const ContactReach reach = reach_of_points(points);
  const Ball broken = largest_ball(Breaking(reach, true)),
             whole = largest_ball(Breaking(reach, false));
  CHECK(whole.end == BallEnd::inside);
  CHECK(broken.end == whole.end);
  CHECK(broken.points == whole.points);
  CHECK(broken.upper == whole.upper);
  for (int i = 0; i < 6; ++i) CHECK(broken.direction[i] == whole.direction[i]);
}

TEST_CASE(
    "soft contacts whose ten points are alike may reach differently far where they lie in a line") {
  Eigen::Matrix<double, 2, 4> a, b;
  a << 0, 1, 0, 0.5, 2, 0, 0, 0;
  b << 0, std::sqrt(0.5), 0, 1, -2, 0, 0, 0;
  a /= 4, b /= 4;
  const ContactPart parts[] = {{.axis = a.data(), .spread = a.data() + 2, .width = 3},
                               {.axis = b.data(), .spread = b.data() + 2, .width = 3}};
  const Ball ball = largest_ball(ContactReach(2, WrenchNorm::l1, parts));
  // the line through the ends of both
  const double low = std::sqrt(1.25) / 4, high = std::sqrt(1.5) / 4;
  CHECK(std::abs(ball.upper - (low + high) / 2 / std::hypot(1, high - low)) < 1e-12);
}

TEST_CASE("sets of very many points are searched as they are") {
  for (const int count : {1000, 1100}) {
    Eigen::MatrixXd ring(2, count);
    const auto directions = ring_directions(count);
    for (int i = 0; i < count; ++i) ring.col(i) = directions[i].head<2>();
    CHECK((cone_of(ring).walls > 0) == (count == 1000));
  }
}

TEST_CASE("of symmetric grasps the polytope grows by a part of their wrenches") {
  for (const int count : {8, 16}) {
    const Wrenches all = side_by_side(wrenches_of(ball_contacts(ring_directions(count), 0.8), 8));
    const Ball ball = largest_ball(reach_of_points(all));
    const Hull hull = convex_hull(all);
    CHECK(std::abs(ball.upper - hull.offsets.minCoeff()) < 1e-12);
    CHECK(ball.points < all.cols() * 2 / 3);
  }
}

TEST_CASE("L-infinity and round cones: as sets that are symmetric but for a little") {
  // A shift of 1e-11 leaves no symmetry that is searched by; sums of eight contacts move by ten times as much.
  Random random(4);
  std::vector<std::vector<PointContact>> grasps;
  for (const int count : {3, 4}) grasps.push_back(ball_contacts(ring_directions(count), 0.8));
  for (const int count : {4, 6}) grasps.push_back(ball_contacts(solid_directions(count), 0.5));
  grasps.push_back(box_contacts(2, 0.5, 0.8));
  // one of three contacts twice: the ring's turns carry contacts no longer one to one
  grasps.push_back(ball_contacts(ring_directions(3), 0.8));
  grasps.back().push_back(grasps.back()[0]);
  int narrowed = 0;
  for (const auto& contacts : grasps)
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf})
      for (const double torsion_radius : {-1.0, 0.0, 0.1}) {
        std::vector<Wrenches> given;  // pyramids, or axes and spreads
        std::vector<ContactPart> parts;
        const bool round = torsion_radius >= 0;
        for (PointContact contact : contacts) {
          contact.torsion_radius = std::max(0.0, torsion_radius);
          if (round) {
            const RoundCone cone = round_cone(contact, {});
            Wrenches all(6, 1 + cone.spread.cols());
            all << cone.axis, cone.spread;
            given.push_back(all / 4);
          } else {
            given.push_back(cone_wrenches(contact, {.edges = 4}) / 4);
          }
        }
        const auto reach = [&] {
          parts.clear();
          for (const Wrenches& w : given) {
            const int count = static_cast<int>(w.cols());
            if (round)
              parts.push_back({.axis = w.data(), .spread = w.data() + 6, .width = count - 1});
            else
              parts.push_back({.points = w.data(), .count = count});
          }
          return ContactReach(6, norm, parts);
        };
        const BallOptions options{.tolerance = 1e-6, .most_facets = 200'000};
        const ContactReach symmetric = reach();
        narrowed += symmetric.least_support_cone().walls > 0;
        const Ball ball = largest_ball(symmetric, options);
        for (Wrenches& w : given)
          for (double& x : w.reshaped()) x += 1e-11 * random.uniform(-1, 1);
        const ContactReach shifted = reach();
        CHECK(shifted.least_support_cone().walls == 0);
        const Ball all = largest_ball(shifted, options);
        CHECK((ball.end == BallEnd::outside) == (all.end == BallEnd::outside));
        // the whole of a ring of round cones is more than those facets
        CHECK((ball.end == BallEnd::inside || all.end != BallEnd::inside));
        CHECK(ball.lower <= all.upper + 1e-9);
        CHECK(ball.upper >= all.lower - 1e-9);
      }
  CHECK(narrowed > 15);
}
