#include "clench/contact/cone.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/contact/friction_edges.h"
#include "clench/spec/valid.h"

namespace clench {

namespace {

// tolerance on the length of a normal, which may have been rounded in a file
constexpr double unit_length = 1e-6;

void check_cone(const PointContact& contact, const ConeOptions& options) {
  if (!contact.p_O.allFinite()) fail("contact cone: the point must be finite");
  const double length = contact.n_O.norm();
  if (!(std::abs(length - 1) <= unit_length))
    fail("contact cone: the normal must be a unit vector, got length {}", length);
  check(friction_rule.called("mu"), contact.mu, "contact cone");
  if (!std::isfinite(contact.torsion_radius) || contact.torsion_radius < 0)
    fail("contact cone: torsion_radius must be >= 0, got {}", contact.torsion_radius);
  if (!std::isfinite(options.rho) || options.rho <= 0)
    fail("contact cone: rho must be > 0, got {}", options.rho);
  if (!options.p_OM.allFinite()) fail("contact cone: the point of torques must be finite");
}

}  // namespace

Eigen::Matrix3d contact_frame(const Eigen::Vector3d& normal) {
  const bool along_e1 = std::abs(normal.x()) > 1 - 1e-9;
  const Eigen::Vector3d reference = along_e1 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  Eigen::Matrix3d frame;
  frame.col(2) = normal;
  frame.col(0) = normal.cross(reference).normalized();
  frame.col(1) = normal.cross(frame.col(0));
  return frame;
}

Wrenches cone_wrenches(const PointContact& contact, const ConeOptions& options) {
  check_cone(contact, options);
  if (options.edges < 3 || options.edges > max_edges)
    fail("contact cone: edges must be 3 to {}, got {}", max_edges, options.edges);
  const Eigen::Matrix3d frame = contact_frame(contact.n_O);
  const Eigen::Vector3d lever = (contact.p_O - options.p_OM) / options.rho;
  if (contact.mu > 0 && contact.torsion_radius > 0) {
    const FrictionEdges edges =
        friction_edges(contact.torsion_radius, options.edges, contact.torsion_radius);
    Wrenches wrenches(6, edges.cols());
    for (int j = 0; j < edges.cols(); ++j) {
      const Eigen::Vector3d force =
          contact.n_O + contact.mu * (frame.leftCols(2) * edges.col(j).head<2>());
      const Eigen::Vector3d turn = contact.n_O * (contact.mu * edges(5, j) / options.rho);
      wrenches.col(j) << force, lever.cross(force) + turn;
    }
    return wrenches;
  }
  const int count = contact.mu == 0 ? 1 : options.edges;
  Wrenches wrenches(6, count);
  for (int j = 0; j < count; ++j) {
    const double angle = 2 * std::numbers::pi * j / count;
    const Eigen::Vector3d tangent = std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1);
    const Eigen::Vector3d force = frame.col(2) + contact.mu * tangent;
    wrenches.col(j) << force, lever.cross(force);
  }
  return wrenches;
}

RoundCone round_cone(const PointContact& contact, const ConeOptions& options) {
  check_cone(contact, options);
  const Eigen::Matrix3d frame = contact_frame(contact.n_O);
  const Eigen::Vector3d lever = (contact.p_O - options.p_OM) / options.rho;
  RoundCone cone;
  cone.axis << contact.n_O, lever.cross(contact.n_O);
  const bool soft = contact.torsion_radius > 0;
  cone.spread.setZero(6, contact.mu == 0 ? 0 : soft ? 3 : 2);
  for (int k = 0; k < cone.spread.cols(); ++k) {
    if (k == 2)
      cone.spread.col(k).tail<3>() = contact.n_O * (contact.torsion_radius / options.rho);
    else
      cone.spread.col(k) << frame.col(k), lever.cross(frame.col(k));
    cone.spread.col(k) *= contact.mu;
  }
  return cone;
}

}  // namespace clench
