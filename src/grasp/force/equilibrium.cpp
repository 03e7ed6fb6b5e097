#include "clench/grasp/force/equilibrium.h"

namespace clench {

static Equilibrium asked_once(const World& world, const Grasp& grasp, ForceOptions asked) {
  Equilibrium out;
  out.result = contact_forces(world, grasp, asked);
  if (out.result.status == ForceStatus::optimal) {
    out.status = EquilibriumStatus::stable;
    return out;
  }
  if (out.result.status != ForceStatus::infeasible) return out;
  asked.nearest = true;
  ForceResult nearest = contact_forces(world, grasp, asked);
  nearest.certificate = out.result.certificate;
  out.result = std::move(nearest);
  if (out.result.status == ForceStatus::optimal) out.status = EquilibriumStatus::unstable;
  if (out.result.status == ForceStatus::infeasible) out.status = EquilibriumStatus::moving;
  return out;
}

Equilibrium equilibrium(const World& world, const Grasp& grasp, const EquilibriumOptions& options) {
  ForceOptions asked;
  asked.load = options.load;
  asked.max_force = options.max_force;
  asked.joints = options.joints;
  const Equilibrium out = asked_once(world, grasp, asked);
  const bool balanced =
      out.status == EquilibriumStatus::stable || out.status == EquilibriumStatus::unstable;
  if (!options.joints.springs_only || balanced) return out;
  // after closing, springs are at rest only within the tolerance of closing, so their balance may
  // be inexact
  asked.joints->nearly_at_rest = true;
  return asked_once(world, grasp, asked);
}

}  // namespace clench
