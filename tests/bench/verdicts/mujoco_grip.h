// A grip simulated by MuJoCo, with MuJoCo's collisions of convex pieces, contact model and solver.
#pragma once
#include <memory>

#include "bench/verdicts/grip_test.h"

namespace clench::bench {

/// Steps of 1 ms; the time constant of contacts is four steps. Joints of one DOF are coupled.
std::unique_ptr<Grip> mujoco_grip(const GripScene& scene, const StoredGrasp& grasp,
                                  const GripOptions& options);

struct LiftVerdict {
  bool held = false;
  double moved = 0, turned = 0;  ///< of the object relative to the hand, at the end [m, rad]
};

/// Under gravity the object rests on the scene's table while the hand presses; then the hand rises
/// by 0.1 m in 1.5 s, and holds still for a second.
/// throws  std::runtime_error if the scene has no table
LiftVerdict lift_in_mujoco(const GripScene& scene, const StoredGrasp& grasp,
                           const GripOptions& options);

}  // namespace clench::bench
