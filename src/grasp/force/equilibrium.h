// Equilibrium of load, contact forces and the hand's joints.
#pragma once
#include "clench/grasp/force/contact_forces.h"

namespace clench {

enum class EquilibriumStatus {
  stable,    ///< some forces balance the load and every joint
  unstable,  ///< the joints can be balanced, but a wrench on the object remains
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
  /// stable: the balance with the least normal forces; unstable: the forces that leave the smallest
  /// wrench, and the proof in `certificate`
  ForceResult result;
};

/// throws Error as contact_forces does
Equilibrium equilibrium(const World& world, const Grasp& grasp, const EquilibriumOptions& options);

}  // namespace clench
