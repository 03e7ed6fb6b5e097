// Stepper::solve_by_ode: the same contacts, motors and limits, with velocities that ODE finds.
#include <algorithm>

#include "clench/base/error.h"
#include "clench/dynamics/ode/ode_step.h"
#include "clench/dynamics/stepper.h"

namespace clench {

// Largest number of contact points. ODE's Dantzig method cannot be stopped, and takes about a second
// for this many; its time is cubic in the number.
static constexpr size_t max_contacts = 1000;

void Stepper::solve_by_ode(double h) {
  std::vector<OdeContact> contacts;
  for (const PlacedBlock& block : blocks_) {
    if (block.row >= 0) continue;
    const TouchingPoint& touch = touches_[block.touch];
    const ManifoldPoint& p = world_.dynamics()->manifolds[touch.manifold].points[touch.point];
    OdeContact contact{
        .a = touch.a, .b = touch.b, .p_W = touch.p_W, .frame = touch.frame, .mu = block.law.mu};
    if (block.law.tangents == 3) contact.spin_radius = block.law.mu * p.torsion_radius;
    contact.target = touch.target;
    // a surface runs along itself
    const Eigen::Vector3d normal = touch.frame.col(0),
                          belt = surface_velocity(touch.b) - surface_velocity(touch.a);
    contact.surface_velocity = belt - belt.dot(normal) * normal;
    const int linear = std::min(block.law.size(), 3);
    contact.free_velocity.head(linear) =
        Eigen::Map<const Eigen::VectorXd>(q_.data() + block.law.row, linear);
    contacts.push_back(contact);
  }
  if (contacts.size() > max_contacts)
    fail(ErrorKind::limit,
         "dynamics: engine 'ode': expected at most {} contact points in a step, got {}; use engine "
         "'clench'",
         max_contacts, contacts.size());
  Eigen::VectorXd before;
  gather_velocities(system_, world_, *world_.dynamics(), before);
  const OdeSolution solution = step_ode(world_,
                                        {.system = system_,
                                         .v = before,
                                         .forces = forces_,
                                         .rows = coordinate_rows_,
                                         .contacts = contacts},
                                        h);
  v_ = solution.v;
  size_t next = 0;
  for (const PlacedBlock& block : blocks_) {
    const int row = block.law.row;
    if (block.row >= 0) {
      r_[row] = solution.row_impulses[block.row];
      continue;
    }
    const ManifoldPoint& p = world_.dynamics()
                                 ->manifolds[touches_[block.touch].manifold]
                                 .points[touches_[block.touch].point];
    const int linear = std::min(block.law.size(), 3);
    r_.segment(row, linear) = solution.impulses[next].head(linear);
    if (block.law.tangents == 3) r_[row + 3] = solution.spins[next] / p.torsion_radius;
    ++next;
  }
  StepReport& report = world_.edit_dynamics().report;
  report.iterations += solution.solves;
  report.fallbacks += solution.softened;
  report.failures += !solution.solved;
  report.residual = std::max(report.residual, solution.residual);
}

}  // namespace clench
