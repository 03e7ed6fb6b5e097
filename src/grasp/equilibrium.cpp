#include "grasp/equilibrium.h"

namespace clench {

Equilibrium equilibrium(const World& world, const Grasp& grasp, const EquilibriumOptions& options) {
  ForceOptions asked;
  asked.load = options.load;
  asked.max_force = options.max_force;
  asked.joints = options.joints;
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

}  // namespace clench
