#include "clench/grasp/wrench/wrench_support.h"

#include "clench/base/random.h"
#include "grasp/wrench_sets.h"

using namespace clench;
using namespace clench::test;

namespace {

std::vector<ContactPart> parts_of(const std::vector<Wrenches>& contacts) {
  std::vector<ContactPart> out;
  for (const Wrenches& w : contacts)
    out.push_back({.points = w.data(), .count = static_cast<int>(w.cols())});
  return out;
}

Vector6d reach_direction(Random& random) {
  Vector6d u;
  for (double& x : u) x = random.normal();
  return u.normalized();
}

// slightly more than the rounding error of six products
constexpr double rounding = 1e-14;

}  // namespace

TEST_CASE(
    "the support of L1 is that of the farthest wrench, and of L-infinity that of the farthest "
    "sum") {
  Random random(1);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<PointContact> contacts(1 + trial % 4);
    for (auto& c : contacts) c = random_contact(random, 0.5);
    const auto set = wrenches_of(contacts, 3 + trial % 3);
    const Wrenches all = side_by_side(set);
    const WrenchSupport l1(6, WrenchNorm::l1, parts_of(set)),
        linf(6, WrenchNorm::linf, parts_of(set));
    // all sums of at most one wrench per contact
    Wrenches sums = Wrenches::Zero(6, 1);
    for (const Wrenches& w : set) {
      Wrenches next(6, sums.cols() * (w.cols() + 1));
      next.leftCols(sums.cols()) = sums;
      for (int k = 0; k < w.cols(); ++k)
        next.middleCols((k + 1) * sums.cols(), sums.cols()) = sums.colwise() + w.col(k);
      sums = next;
    }
    for (int i = 0; i < 20; ++i) {
      const Vector6d u = reach_direction(random);
      Vector6d p;
      CHECK(std::abs(l1.support(u.data(), p.data()) - (u.transpose() * all).maxCoeff()) < rounding);
      CHECK(std::abs(u.dot(p) - (u.transpose() * all).maxCoeff()) < rounding);
      CHECK(std::abs(linf.support(u.data(), p.data()) - (u.transpose() * sums).maxCoeff()) <
            4 * rounding);
      CHECK(std::abs(u.dot(p) - (u.transpose() * sums).maxCoeff()) < 4 * rounding);
      for (size_t c = 0; c < set.size(); ++c)
        CHECK(std::abs(l1.support_of(static_cast<int>(c), u.data()) -
                       (u.transpose() * set[c]).maxCoeff()) < rounding);
    }
  }
}

TEST_CASE("the support of a round part agrees with a dense sample of points") {
  Random random(2);
  for (const double torsion : {0.0, 0.3}) {
    PointContact contact = random_contact(random, 0.7);
    contact.torsion_radius = torsion;
    const RoundCone cone = round_cone(contact);
    const ContactPart part{.axis = cone.axis.data(),
                           .spread = cone.spread.data(),
                           .width = static_cast<int>(cone.spread.cols())};
    const WrenchSupport reach(6, WrenchNorm::l1, std::span(&part, 1));
    for (int i = 0; i < 20; ++i) {
      const Vector6d u = reach_direction(random);
      Vector6d p;
      const double most = reach.support(u.data(), p.data());
      CHECK(std::abs(u.dot(p) - most) < rounding);
      // the support point belongs to the cone
      Eigen::VectorXd x(cone.spread.cols()), rest = p - cone.axis;
      for (int k = 0; k < x.size(); ++k) {
        // tangents are identified by their forces, and torsion by the rest
        const int rows = k < 2 ? 3 : 6;
        const auto column = cone.spread.col(k).head(rows);
        x[k] = column.dot(rest.head(rows)) / column.squaredNorm();
        rest -= x[k] * cone.spread.col(k);
      }
      CHECK(rest.norm() < rounding);
      CHECK(x.norm() == doctest::Approx(1).epsilon(1e-12));
      double sampled = -1e9;
      for (int k = 0; k < 3000; ++k) {
        Eigen::VectorXd y(cone.spread.cols());
        for (double& v : y) v = random.normal();
        sampled = std::max(sampled, u.dot(cone.axis + cone.spread * y.normalized()));
      }
      CHECK(sampled <= most + rounding);
      // 3000 points on a sphere leave gaps of about a tenth
      CHECK(sampled > most - 0.02);
    }
  }
}

TEST_CASE("in L-infinity the support is 0 in a direction that no contact pushes along") {
  const Wrenches up = Vector6d::Unit(2);
  const ContactPart part{.points = up.data(), .count = 1};
  const WrenchSupport reach(6, WrenchNorm::linf, std::span(&part, 1));
  const Vector6d down = -Vector6d::Unit(2);
  Vector6d p;
  CHECK(reach.support(down.data(), p.data()) == 0);
  CHECK(p.isZero(0));
  CHECK(WrenchSupport(6, WrenchNorm::l1, {}).empty());
}
