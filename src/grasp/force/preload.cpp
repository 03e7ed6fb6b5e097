#include "clench/grasp/force/preload.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clench/base/error.h"
#include "clench/grasp/force/contact_forces.h"
#include "clench/grasp/force/force_program.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::VectorXd;

namespace {

// Do the forces at `start` balance the load, within 1e-7 of the largest force or load?
bool holds(const ForceProgram& p, int start, const Vector6d& load_O) {
  const VectorXd f = p.solution.x.segment(start, p.map.forces());
  Vector6d sum = p.map.matrix * f + load_O, size = p.map.matrix.cwiseAbs() * f.cwiseAbs();
  size += load_O.cwiseAbs();
  for (Vector6d* wrench : {&sum, &size}) wrench->tail<3>() /= p.arm;
  return sum.lpNorm<Eigen::Infinity>() <= 1e-7 * size.lpNorm<Eigen::Infinity>();
}

VectorXd normals_at(const ForceProgram& p, int start) {
  VectorXd out(p.map.contacts());
  for (int i = 0; i < out.size(); ++i) out[i] = p.solution.x[start + p.map.starts[i]];
  return out;
}

// the program that holds all loads; none if the elastic forces cannot balance one of them
std::optional<LoadedProgram> preload_program(const World& world, const Grasp& grasp,
                                             const ForceOptions& asked,
                                             const std::vector<Vector6d>& loads_O, bool locked) {
  if (!locked) return make_constant_preload(world, grasp, asked, loads_O);
  std::vector<VectorXd> responses;
  for (const Vector6d& load_O : loads_O) {
    responses.push_back(elastic_response(grasp, load_O));
    if (responses.back().size() == 0) return {};
  }
  return make_locked_preload(world, grasp, asked, responses);
}

}  // namespace

VectorXd elastic_response(const Grasp& grasp, const Vector6d& load_O) {
  const GraspMap map = grasp_map(grasp.points, grasp.com);
  if (map.forces() == 0) return {};
  // torsion over its radius, torque over rho
  VectorXd units = VectorXd::Ones(map.forces());
  for (int i = 0; i < map.contacts(); ++i)
    if (map.starts[i + 1] - map.starts[i] == 4)
      units[map.starts[i] + 3] = grasp.points[i].torsion_radius;
  Vector6d rows = Vector6d::Ones();
  rows.tail<3>() /= grasp.rho;
  const Eigen::MatrixXd m = rows.asDiagonal() * map.matrix * units.asDiagonal();
  const Vector6d load = rows.cwiseProduct(load_O);
  const Svd svd = singular_value_decomposition(m);
  VectorXd f = VectorXd::Zero(m.cols());
  for (int k = 0; k < svd.values.size(); ++k)
    if (svd.values[k] > 1e-10 * svd.values[0])
      f -= svd.v.col(k) * (svd.u.col(k).dot(load) / svd.values[k]);
  if ((m * f + load).norm() > 1e-9 * load.norm()) return {};
  return units.cwiseProduct(f);
}

Preload optimal_preload(const World& world, const Grasp& grasp, const PreloadOptions& options) {
  if (options.loads.empty()) fail("optimal preload: expected at least one load, got none");
  ForceOptions asked{.max_force = options.max_force, .joints = options.joints};
  const Eigen::Matrix3d R_OW = world.pose(grasp.object).matrix().transpose();
  std::vector<Vector6d> loads_O;
  for (const Vector6d& load : options.loads) {
    asked.load = load;
    check_force_options(world, grasp, asked);
    loads_O.push_back(turned_wrench(load, R_OW));
  }
  Preload out;
  const auto many = preload_program(world, grasp, asked, loads_O, options.locked);
  out.status = many ? many->program.solution.status : ConeStatus::infeasible;
  if (out.status != ConeStatus::optimal) return out;
  const ForceProgram& p = many->program;
  const int dofs = static_cast<int>(world.robot(grasp.hand).dofs.size());
  out.efforts = p.solution.x.segment(many->efforts, dofs) + p.at_rest.head(dofs);
  out.fraction = std::max(0.0, p.solution.x[p.extra] / many->unit);
  for (size_t k = 0; k < loads_O.size(); ++k) {
    if (!holds(p, many->forces[k], loads_O[k])) out.status = ConeStatus::inaccurate;
    out.normals.push_back(normals_at(p, many->forces[k]));
  }
  return out;
}

}  // namespace clench
