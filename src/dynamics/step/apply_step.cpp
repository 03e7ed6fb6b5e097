#include "clench/dynamics/step/apply_step.h"

#include <algorithm>

#include "clench/dynamics/step/breakaway.h"

namespace clench {
namespace {

void set_velocities(const World& world, const System& system, const StepProblem& problem,
                    const StepSolution& solution, DynamicState& state) {
  scatter_velocities(system, world, solution.v, state);
  for (size_t t = 0; t < system.trees.size(); ++t) {
    const Articulation& tree = system.trees[t];
    const Vector6d root = prescribed_twist(world, tree);
    for (size_t b = 0; b < tree.bodies.size(); ++b)
      if (tree.bodies[b].body != tree.root)
        state.twists[tree.bodies[b].body.index] = problem.trees[t].twist(
            static_cast<int>(b), solution.v.segment(tree.first, tree.size()), root);
  }
  state.solved = state.twists;
}

void set_contact_force(const World& world, const TouchingPoint& touch, const StepBlock& block,
                       const Eigen::VectorXd& r, DynamicState& state) {
  Manifold& m = state.manifolds[touch.manifold];
  ManifoldPoint& p = m.points[touch.point];
  const int row = block.law.row, linear = std::min(block.law.size(), 3);
  const Eigen::Vector3d impulse =
      touch.frame.leftCols(linear) * Eigen::Map<const Eigen::VectorXd>(r.data() + row, linear);
  p.force = world.pose(m.a).rotation.conjugate() * Eigen::Vector3d(impulse / block.time);
  if (block.law.tangents == 3) p.torsion = r[row + 3] * p.torsion_radius / block.time;
}

void set_forces(const World& world, const System& system, const StepProblem& problem,
                const Eigen::VectorXd& r, DynamicState& state) {
  for (Manifold& m : state.manifolds)
    for (ManifoldPoint& p : m.points) p.force.setZero(), p.torsion = 0;
  state.row_forces.clear();
  for (const Articulation& tree : system.trees)
    for (const Coordinate& c : tree.coordinates)
      if (c.joint < 0) state.dof_efforts[c.dof_index] = feedforward_effort(world, c, state);
  for (const StepBlock& block : problem.blocks) {
    if (block.touch >= 0) {
      set_contact_force(world, problem.touches[block.touch], block, r, state);
      continue;
    }
    const CoordinateRow& c = problem.coordinate_rows[block.coordinate_row];
    const double force = r[block.law.row] / block.time;
    state.row_forces.push_back({c.kind, c.index, force});
    if (c.kind == RowKind::motor) state.dof_efforts[c.index] += force;
  }
  std::ranges::sort(state.row_forces, {},
                    [](const RowForce& row) { return std::pair(row.kind, row.index); });
}

}  // namespace

void apply_step(World& world, const System& system, StepProblem& problem,
                const StepSolution& solution) {
  DynamicState& state = world.edit_dynamics();
  set_velocities(world, system, problem, solution, state);
  set_forces(world, system, problem, solution.r, state);
  disengage_joints(world, system, problem, solution.v);
  for (Load& load : state.loads) load = {};
  StepReport& report = state.report;
  report.iterations += solution.iterations;
  report.fallbacks += solution.fallbacks;
  report.failures += solution.failures;
  report.residual = solution.residual;
  report.contacts = static_cast<int>(problem.touches.size());
  report.max_residual = std::max(report.max_residual, report.residual);
  ++report.steps;
}

}  // namespace clench
