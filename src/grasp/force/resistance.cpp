#include "clench/grasp/force/resistance.h"

#include <limits>

#include "clench/base/error.h"
#include "clench/grasp/force/contact_forces.h"

namespace clench {

double resistance(const World& world, const Grasp& grasp, const Vector6d& wrench_W,
                  const ResistanceOptions& options) {
  if (!wrench_W.allFinite()) fail("resistance: the wrench must be finite");
  if (wrench_W.isZero(0)) return std::numeric_limits<double>::infinity();
  ForceOptions forces{.load = wrench_W};
  if (options.norm == WrenchNorm::l1)
    forces.max_total_force = 1;
  else
    forces.max_force = 1;
  const ForceResult most = max_load(world, grasp, forces);
  if (most.status == ForceStatus::infeasible) return 0;
  if (most.status != ForceStatus::optimal)
    fail("resistance: the solver stopped short of an answer for this wrench");
  return most.load_factor;
}

double ellipsoid_resistance(const World& world, const Grasp& grasp, const Vector6d& axes_W,
                            const ResistanceOptions& options) {
  for (const double axis : axes_W)
    if (!(axis > 0) || !std::isfinite(axis))
      fail("resistance: half axes of an ellipsoid must be > 0, got {} [N or N m]", axis);
  // a thickness of a billionth is sufficient for a flat ellipsoid, and the scaling to a ball stays
  // accurate
  const Vector6d axes = axes_W.cwiseMax(1e-8 * axes_W.maxCoeff());

  // coordinates in which the ellipsoid is a ball: along the world's axes, each divided by its half
  // axis
  const Eigen::Matrix3d R_WO = world.pose(grasp.object).matrix();
  Eigen::Matrix<double, 6, 6> to_ball = Eigen::Matrix<double, 6, 6>::Zero();
  to_ball.topLeftCorner<3, 3>() = R_WO;
  to_ball.bottomRightCorner<3, 3>() = R_WO;
  to_ball = axes.cwiseInverse().asDiagonal() * to_ball;

  const ConeOptions cone{.edges = grasp.options.edges, .rho = 1, .p_OM = grasp.com};
  std::vector<UnitWrenches> contacts;
  for (const PointContact& point : grasp.points) {
    UnitWrenches unit = unit_wrenches(point, cone);
    unit.edges = (to_ball * unit.edges).eval();
    if (unit.round) {
      unit.round->axis = (to_ball * unit.round->axis).eval();
      unit.round->spread = (to_ball * unit.round->spread).eval();
    }
    contacts.push_back(std::move(unit));
  }
  return WrenchSpace(std::move(contacts), {.norm = options.norm}).epsilon();
}

}  // namespace clench
