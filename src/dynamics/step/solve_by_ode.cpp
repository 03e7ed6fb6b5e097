#include "clench/dynamics/step/solve_by_ode.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/dynamics/ode/ode_step.h"

namespace clench {

static constexpr size_t max_contacts = 1000;  // about a second

StepSolution solve_by_ode(const World& world, const System& system, const StepProblem& problem) {
  std::vector<OdeContact> contacts;
  for (const StepBlock& block : problem.blocks) {
    if (block.touch < 0) continue;
    const TouchingPoint& touch = problem.touches[block.touch];
    OdeContact contact{
        .a = touch.a, .b = touch.b, .p_W = touch.p_W, .frame = touch.frame, .mu = block.law.mu};
    if (block.law.tangents == 3) contact.spin_radius = block.law.mu * touch.torsion_radius;
    contact.target = touch.target;
    contact.surface_velocity = touch.belt_W;
    const int linear = std::min(block.law.size(), 3);
    contact.free_velocity.head(linear) =
        Eigen::Map<const Eigen::VectorXd>(problem.q.data() + block.law.row, linear);
    contacts.push_back(contact);
  }
  if (contacts.size() > max_contacts)
    fail(ErrorKind::limit,
         "dynamics: engine 'ode': expected at most {} contact points in a step, got {}; use engine "
         "'clench'",
         max_contacts, contacts.size());
  const OdeSolution solution = step_ode(world,
                                        {.system = system,
                                         .v = problem.v_before,
                                         .forces = problem.forces,
                                         .root_accelerations = problem.root_accelerations,
                                         .rows = problem.coordinate_rows,
                                         .contacts = contacts},
                                        problem.h);
  StepSolution out{.v = solution.v,
                   .r = Eigen::VectorXd::Zero(problem.rows()),
                   .iterations = solution.solves,
                   .fallbacks = solution.softened,
                   .failures = !solution.solved,
                   .residual = solution.residual};
  size_t next = 0;
  for (const StepBlock& block : problem.blocks) {
    const int row = block.law.row;
    if (block.touch < 0) {
      out.r[row] = solution.row_impulses[block.coordinate_row];
      continue;
    }
    const int linear = std::min(block.law.size(), 3);
    out.r.segment(row, linear) = solution.impulses[next].head(linear);
    if (block.law.tangents == 3)
      out.r[row + 3] = solution.spins[next] / problem.touches[block.touch].torsion_radius;
    ++next;
  }
  return out;
}

}  // namespace clench
