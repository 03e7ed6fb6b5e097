// Torques that motors keep while loads on the object change.
#pragma once
#include "clench/grasp/force/force_options.h"
#include "clench/math/cone_program.h"

namespace clench {

struct PreloadOptions {
  /// loads that the preload holds, one at a time, as in ForceOptions; not empty
  std::vector<Vector6d> loads;
  /// joints do not move under a load; contacts yield as equal springs
  bool locked = false;
  PerContact max_force = {};  ///< caps of normal forces, > 0 [N]
  JointDemand joints = {};    ///< limits, unlimited, unilateral, arms, link_weights
};

struct Preload {
  /// optimal or infeasible; inaccurate: the result does not pass its check
  ConeStatus status = ConeStatus::inaccurate;
  Eigen::VectorXd efforts;  ///< of the hand's motors [N m or N]
  /// largest effort as a fraction of its limit; motors without a limit count as if it was 1
  double fraction = 0;
  std::vector<Eigen::VectorXd> normals;  ///< per load: normal force of each contact [N]
};

/// Changes of the contact forces by a load on the object if no joint moves and each contact yields
/// as a spring, equally stiff along its normal and its tangents, and about its normal times the
/// square of its torsion radius: the smallest forces that balance the load.
/// returns  forces as in the grasp map; empty if no forces balance the load
/// source   Bicchi (1994), On the problem of decomposing grasp and manipulation forces in multiple
///          whole-limb manipulation
Eigen::VectorXd elastic_response(const Grasp& grasp, const Vector6d& load_O);

/// The torques of the motors with the smallest largest fraction of their limits for which contact
/// forces at each load lie within their cones. The torques are constant; clutches and the motors of
/// arms adjust to the load. `locked`: the torques press before the load is applied, and the elastic
/// response adds to these forces.
/// throws  Error as contact_forces does, and if there are no loads
Preload optimal_preload(const World& world, const Grasp& grasp, const PreloadOptions& options);

}  // namespace clench
