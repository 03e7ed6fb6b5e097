#include "clench/grasp/wrench/sum_volume.h"

#include <algorithm>

#include "clench/geometry/mesh/hull.h"
#include "grasp/wrench_sets.h"
#include "support/cases.h"

using namespace clench;
using namespace clench::test;

namespace {

constexpr int plenty = 100000;

// hulls of zero and each contact's wrenches
std::vector<Eigen::MatrixXd> pyramids(const std::vector<PointContact>& contacts, int edges) {
  std::vector<Eigen::MatrixXd> out;
  for (const Wrenches& w : wrenches_of(contacts, edges)) {
    out.push_back(Eigen::MatrixXd::Zero(6, w.cols() + 1));
    out.back().rightCols(w.cols()) = w;
  }
  return out;
}

std::vector<PointContact> random_contacts(Random& random, int count, bool soft) {
  std::vector<PointContact> out(count);
  for (PointContact& c : out) {
    c = random_contact(random, random.uniform(0.1, 1));
    if (soft) c.torsion_radius = random.uniform(0.02, 0.3);
  }
  return out;
}

// brute-force reference: the hull of all sums of points
double enumerated_volume(const std::vector<Eigen::MatrixXd>& summands) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(summands[0].rows(), 1);
  for (const Eigen::MatrixXd& summand : summands) {
    Eigen::MatrixXd more(sums.rows(), sums.cols() * summand.cols());
    for (Eigen::Index i = 0; i < sums.cols(); ++i)
      more.middleCols(i * summand.cols(), summand.cols()) = summand.colwise() + sums.col(i);
    sums = std::move(more);
  }
  return convex_hull(sums).volume;
}

double volume_of(const std::vector<Eigen::MatrixXd>& summands) {
  const SumVolume sum = sum_volume(summands, plenty);
  REQUIRE(sum.end == SumVolume::complete);
  return sum.volume;
}

// turned, in another order, each summand moved: another lifting of the same sum
std::vector<Eigen::MatrixXd> elsewhere(std::vector<Eigen::MatrixXd> summands, Random& random) {
  Eigen::Matrix3d turn =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized()
          .toRotationMatrix();
  for (Eigen::MatrixXd& s : summands) {
    s.topRows(3) = (turn * s.topRows(3)).eval();
    s.bottomRows(3) = (turn * s.bottomRows(3)).eval();
    s = s.rowwise().reverse().eval();
    s.colwise() += Eigen::VectorXd(random_normal_wrenches(random, 1));
  }
  std::reverse(summands.begin(), summands.end());
  return summands;
}

}  // namespace

TEST_CASE("sums have the volume of the hull of all sums of points") {
  Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const auto triple = pyramids(random_contacts(random, 3, false), 3 + trial % 2);
    CHECK(volume_of(triple) == doctest::Approx(enumerated_volume(triple)).epsilon(1e-10));
  }
  const auto four = pyramids(random_contacts(random, 4, false), 3);
  CHECK(volume_of(four) == doctest::Approx(enumerated_volume(four)).epsilon(1e-10));
  // a pair of soft contacts with few edges
  auto soft = pyramids(random_contacts(random, 2, true), 8);
  for (Eigen::MatrixXd& s : soft) s = s.leftCols(12).eval();
  CHECK(volume_of(soft) == doctest::Approx(enumerated_volume(soft)).epsilon(1e-10));
}

TEST_CASE("products and parallel sums have the volumes of closed formulas") {
  // boxes in complementary subspaces; a box and itself; segments
  Eigen::MatrixXd cube(6, 8), other(6, 8);
  cube.setZero(), other.setZero();
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) cube(k, i) = other(k + 3, i) = i >> k & 1;
  CHECK(volume_of({cube, other}) == doctest::Approx(1));
  CHECK(volume_of({cube, other, cube, other}) == doctest::Approx(64));
  CHECK(volume_of({cube, cube}) == 0);
  CHECK(volume_of({cube + other}) == 0);
  std::vector<Eigen::MatrixXd> segments(6, Eigen::MatrixXd::Zero(6, 2));
  for (int k = 0; k < 6; ++k) segments[k](k, 1) = k + 1;
  CHECK(volume_of(segments) == doctest::Approx(720));
  CHECK(sum_volume(segments, 0).end == SumVolume::too_many);
  // flat except for 1e-4
  segments[5](5, 1) = 6e-4;
  CHECK(volume_of(segments) == doctest::Approx(720e-4));
}

TEST_CASE(
    "sums of two, three and four random contacts have the same volume in any position and order") {
  Random random(2);
  const auto check = [&](const std::vector<Eigen::MatrixXd>& summands) {
    const double volume = volume_of(summands);
    CHECK(volume > 0);
    CHECK(volume_of(elsewhere(summands, random)) == doctest::Approx(volume).epsilon(1e-10));
  };
  for (int trial = 0; trial < test::cases(8); ++trial) {
    check(pyramids(random_contacts(random, 2, true), 8));
    check(pyramids(random_contacts(random, 3, false), 8));
  }
  for (int trial = 0; trial < 1; ++trial) check(pyramids(random_contacts(random, 4, false), 8));
}

TEST_CASE("symmetric grasps, whose faces are parallel, have the volume of all sums") {
  for (const int count : {3, 4}) {
    const auto ring = pyramids(ball_contacts(ring_directions(count), 0.5), 4 - count % 2);
    CHECK(volume_of(ring) == doctest::Approx(enumerated_volume(ring)).epsilon(1e-10));
  }
  const auto four = pyramids(ball_contacts(solid_directions(4), 0.5), 3);
  CHECK(volume_of(four) == doctest::Approx(enumerated_volume(four)).epsilon(1e-10));
  auto opposed = ball_contacts({{1, 0, 0}, {-1, 0, 0}}, 0.5);
  CHECK(volume_of(pyramids(opposed, 8)) == 0);
  for (PointContact& c : opposed) c.torsion_radius = 0.1;
  Random random(3);
  const auto soft = pyramids(opposed, 8);
  const double volume = volume_of(soft);
  CHECK(volume_of(elsewhere(soft, random)) == doctest::Approx(volume).epsilon(1e-10));
  // the same wrenches by qhull
  CHECK(volume == doctest::Approx(enumerated_volume(soft)).epsilon(1e-9));
}
