// The largest multiple of a wrench, or of a set of task wrenches, that a grasp resists.
#pragma once
#include "clench/grasp/wrench/grasp.h"

namespace clench {

struct ResistanceOptions {
  /// l1: all normal forces sum to at most one newton; linf: each is at most one newton
  WrenchNorm norm = WrenchNorm::l1;
};

/// The largest multiple of a wrench on the object that contact forces in round cones balance;
/// infinite for a zero wrench. A task-specific measure: the weight of the object, or the load of a
/// tool.
///
/// wrench_W  world axes, torque about the object's center of mass [N, N m]
/// throws    Error if a number is not finite
/// source    Borst, Fischer & Hirzinger (2004), Grasp planning: how to choose a suitable task
///           wrench space
double resistance(const World& world, const Grasp& grasp, const Vector6d& wrench_W,
                  const ResistanceOptions& options = {});

/// The largest multiple of an ellipsoid of wrenches all of which are resisted, by pyramids with the
/// edges of the grasp (round cones: within 1e-9). 0 without force closure.
///
/// axes_W  half axes along the world's axes, torques about the object's center of mass, > 0 [N, N
///         m]
/// throws  Error if one is not a number > 0
/// source  Li & Sastry (1988), Task-oriented optimal grasping by multifingered robot hands
double ellipsoid_resistance(const World& world, const Grasp& grasp, const Vector6d& axes_W,
                            const ResistanceOptions& options = {});

}  // namespace clench
