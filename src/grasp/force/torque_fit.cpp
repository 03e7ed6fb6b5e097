#include "clench/grasp/force/torque_fit.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/grasp/force/contact_forces.h"
#include "clench/grasp/force/force_program.h"
#include "clench/math/solve_cone_program.h"

namespace clench {

using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

void check_family(const TorqueFamily& family, Eigen::Index dofs) {
  const auto expect = [](const char* name, Eigen::Index expected, Eigen::Index got) {
    if (expected != got) fail("fit of torques: {}: expected {}, got {}", name, expected, got);
  };
  expect("base: one number per DOF", dofs, family.base.size());
  expect("columns: one row per DOF", dofs, family.columns.rows());
  expect("ranges: one per parameter", family.columns.cols(), family.low.size());
  expect("ranges: one per parameter", family.columns.cols(), family.high.size());
  if (!family.base.allFinite() || !family.columns.allFinite() || !family.low.allFinite() ||
      !family.high.allFinite())
    fail("fit of torques: expected finite numbers");
  for (Eigen::Index i = 0; i < family.low.size(); ++i)
    if (family.low[i] > family.high[i])
      fail("fit of torques: range {}: expected minimum <= maximum, got {} and {}", i + 1,
           family.low[i], family.high[i]);
}

class Fit {
 public:
  Fit(const World& world, const Grasp& grasp, const TorqueFamily& family,
      const TorqueFitOptions& options);
  TorqueFit result() const;

 private:
  void add_balance(const Vector6d& load_O);
  void add_joints();
  void add_contacts(const PerContact& max_force);
  void add_ranges();
  void add_objective();

  const Grasp& grasp_;
  const TorqueFamily& family_;
  VectorXd middle_, half_;  // of the ranges: the unknowns are parameters from -1 to 1
  GraspMap map_;
  JointBalance joints_;
  int dofs_, clutches_;
  ConeBuilder builder_;
  int f_ = 0, p_ = 0, c_ = 0, r_ = 0, t_ = 0;  // columns of the unknowns
};

Fit::Fit(const World& world, const Grasp& grasp, const TorqueFamily& family,
         const TorqueFitOptions& options)
    : grasp_(grasp),
      family_(family),
      middle_(0.5 * (family.low + family.high)),
      half_(0.5 * (family.high - family.low)),
      map_(grasp_map(grasp.points, grasp.com)),
      joints_(joint_balance(world, grasp, false, options.link_weights)),
      dofs_(static_cast<int>(world.robot(grasp.hand).dofs.size())),
      clutches_(static_cast<int>(joints_.refs.size()) - dofs_) {
  f_ = builder_.unknowns(map_.forces());
  p_ = builder_.unknowns(static_cast<int>(family.columns.cols()));
  c_ = builder_.unknowns(clutches_);
  r_ = builder_.unknowns(static_cast<int>(joints_.forces.rows()));
  t_ = builder_.unknowns(1);
  add_balance(turned_wrench(options.load, world.pose(grasp.object).matrix().transpose()));
  add_joints();
  add_ranges();
  add_contacts(options.max_force);
  add_objective();
}

void Fit::add_balance(const Vector6d& load_O) {
  Vector6d rows = Vector6d::Ones();
  rows.tail<3>() /= grasp_.rho;
  builder_.equal({{f_, rows.asDiagonal() * map_.matrix}}, -rows.cwiseProduct(load_O));
}

// contact forces = torques of the family, clutches and springs, and an error
void Fit::add_joints() {
  const MatrixXd motors = joints_.efforts.leftCols(dofs_);
  const auto rows = joints_.forces.rows();
  builder_.equal({{f_, joints_.forces},
                  {p_, -motors * family_.columns * half_.asDiagonal()},
                  {c_, -joints_.efforts.rightCols(clutches_)},
                  {r_, -MatrixXd::Identity(rows, rows)}},
                 joints_.springs + motors * (family_.base + family_.columns * middle_));
}

void Fit::add_ranges() {
  const auto bound = [&](int column, double sign, double limit) {
    if (std::isfinite(limit))
      builder_.at_most({{column, MatrixXd::Constant(1, 1, sign)}},
                       VectorXd::Constant(1, sign * limit));
  };
  for (int i = 0; i < family_.low.size(); ++i) bound(p_ + i, 1, 1), bound(p_ + i, -1, -1);
  for (int i = 0; i < clutches_; ++i)
    bound(c_ + i, 1, joints_.high[dofs_ + i]), bound(c_ + i, -1, joints_.low[dofs_ + i]);
}

void Fit::add_contacts(const PerContact& max_force) {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  if (max_force)
    for (int i = 0; i < map_.contacts(); ++i)
      builder_.at_most({{f_ + map_.starts[i], one}}, VectorXd::Constant(1, max_force.of(i)));
  for (int i = 0; i < map_.contacts(); ++i) {
    const PointContact& contact = grasp_.points[i];
    const int count = map_.starts[i + 1] - map_.starts[i];
    MatrixXd own = MatrixXd::Identity(count, count);
    if (count > 1) own(0, 0) = contact.mu;
    if (count == 4) own(3, 3) = 1 / contact.torsion_radius;
    builder_.cone({{f_ + map_.starts[i], own}});
  }
}

// the length of the error
void Fit::add_objective() {
  const auto rows = joints_.forces.rows();
  MatrixXd length = MatrixXd::Zero(rows + 1, 1), errors = MatrixXd::Zero(rows + 1, rows);
  length(0, 0) = 1;
  errors.bottomRows(rows).setIdentity();
  builder_.cone({{t_, length}, {r_, errors}});
  builder_.cost(t_, 1);
}

TorqueFit Fit::result() const {
  const ConeSolution solution = solve(builder_.program());
  TorqueFit out;
  out.status = solution.status;
  if (out.status != ConeStatus::optimal && out.status != ConeStatus::inaccurate) return out;
  out.parameters = middle_ + half_.cwiseProduct(solution.x.segment(p_, family_.columns.cols()));
  out.parameters = out.parameters.cwiseMax(family_.low).cwiseMin(family_.high);
  out.torques = family_.base + family_.columns * out.parameters;
  out.errors = solution.x.segment(r_, joints_.forces.rows());
  out.error = out.errors.norm();
  out.normals.resize(map_.contacts());
  for (int i = 0; i < map_.contacts(); ++i) out.normals[i] = solution.x[f_ + map_.starts[i]];
  return out;
}

}  // namespace

TorqueFit fit_torques(const World& world, const Grasp& grasp, const TorqueFamily& family,
                      const TorqueFitOptions& options) {
  check_force_options(world, grasp, {.load = options.load, .max_force = options.max_force});
  check_family(family, static_cast<Eigen::Index>(world.robot(grasp.hand).dofs.size()));
  if (grasp.points.empty()) fail("fit of torques: expected a grasp with contacts, got none");
  return Fit(world, grasp, family, options).result();
}

}  // namespace clench
