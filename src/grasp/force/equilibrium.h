// Is there a balance of load, contact forces and the hand's joints?
#pragma once
#include "clench/grasp/force/contact_forces.h"

namespace clench {

enum class EquilibriumStatus {
  stable,    ///< there are forces that balance the load and every joint
  unstable,  ///< the joints can be balanced, but then a wrench on the object is left
  moving,    ///< no contact forces balance the joints: a finger moves, whatever the load
  inaccurate,
};

struct EquilibriumOptions {
  Vector6d load = Vector6d::Zero();  ///< as in ForceOptions
  JointDemand joints = {};           ///< by default the motors' own limits
  PerContact max_force = {};         ///< caps of normal forces, > 0 [N]
};

struct Equilibrium {
  EquilibriumStatus status = EquilibriumStatus::inaccurate;
  /// stable: the balance of least normal forces; unstable: what leaves the least wrench, and the
  /// proof in `certificate`
  ForceResult result;
};

/// throws Error as contact_forces does
Equilibrium equilibrium(const World& world, const Grasp& grasp, const EquilibriumOptions& options);

}  // namespace clench
