// A grip in MuJoCo: its own collisions of convex pieces, its own contact model, its own solver.
#pragma once
#include <memory>

#include "bench/verdicts/grip_test.h"

namespace clench::bench {

/// Steps of 1 ms; contacts as stiff as four of them allow. Joints of one DOF are coupled.
std::unique_ptr<Grip> mujoco_grip(const GripScene& scene, const StoredGrasp& grasp,
                                  const GripOptions& options);

struct LiftVerdict {
  bool held = false;
  double moved = 0, turned = 0;  ///< of the object in the hand, in the end [m, rad]
};

/// Under gravity the object rests on the scene's table while the hand presses; then the hand rises
/// by 0.1 m in 1.5 s, and stays for a second.
/// throws  std::runtime_error when the scene has no table
LiftVerdict lift_in_mujoco(const GripScene& scene, const StoredGrasp& grasp,
                           const GripOptions& options);

}  // namespace clench::bench
