#include "clench/grasp/wrench/nearest_point.h"

#include "clench/grasp/wrench/wrench_support.h"
#include "grasp/wrench_sets.h"

using namespace clench;
using namespace clench::test;

namespace {

NearestPoint nearest_of(const Eigen::MatrixXd& points, const Eigen::VectorXd& place) {
  const ContactPart part{.points = points.data(), .count = static_cast<int>(points.cols())};
  return nearest_point(
      WrenchSupport(static_cast<int>(points.rows()), WrenchNorm::l1, std::span(&part, 1)), place);
}

}  // namespace

TEST_CASE("no point of the set is nearer: all lie beyond the plane through the nearest point") {
  Random random(1);
  for (int d = 1; d <= 6; ++d)
    for (int trial = 0; trial < 60; ++trial) {
      Eigen::MatrixXd points(d, 1 + trial % 30);
      for (double& x : points.reshaped()) x = random.normal() / 4;
      points.row(0).array() += trial % 2;
      if (trial % 3 == 0) points = (4 * points).array().round() / 4;
      const Eigen::VectorXd place = Eigen::VectorXd::Constant(d, 0.05 * (trial % 5));
      const NearestPoint nearest = nearest_of(points, place);
      const Eigen::VectorXd away = nearest.point - place;
      CHECK(std::abs(away.norm() - nearest.distance) < 1e-12);
      CHECK((away.transpose() * (points.colwise() - nearest.point)).minCoeff() > -1e-11);
      // and it belongs to the set
      double sum = 0;
      Eigen::VectorXd mixed = Eigen::VectorXd::Zero(d);
      for (size_t i = 0; i < nearest.shares.size(); ++i) {
        CHECK(nearest.shares[i] > 0);
        sum += nearest.shares[i];
        mixed += nearest.shares[i] * nearest.corners.col(static_cast<int>(i));
      }
      CHECK(std::abs(sum - 1) < 1e-12);
      CHECK((mixed - nearest.point).norm() < 1e-12);
    }
}

TEST_CASE("hard sets of every kind have a nearest point, with or without repeated points") {
  for (int kind = 0; kind < wrench_set_kinds; ++kind)
    for (uint64_t number = 0; number < 30; ++number) {
      CAPTURE(wrench_set_kind(kind));
      CAPTURE(number);
      const Wrenches all = side_by_side(wrench_set(kind, number)) / 4;
      const NearestPoint nearest = nearest_of(all, Vector6d::Zero());
      if (nearest.distance < 1e-9) continue;
      // the plane through the nearest point is accurate to rounding divided by the distance
      CHECK((nearest.point.transpose() * (all.colwise() - Vector6d(nearest.point))).minCoeff() >
            -1e-12 * (1 + nearest.distance));
    }
}
