// A grip in Bullet, with its collision detection of convex pieces, its reduced coordinates and its
// solver.
#pragma once
#include <memory>

#include "bench/verdicts/grip_test.h"

namespace clench::bench {

struct BulletOptions {
  double step = 0.0005;  // [s]
  double kd = 0.1;       // of the servos [N m s/rad]; 100 times that for prismatic joints [N s/m]
  int iterations = 20;
};

std::unique_ptr<Grip> bullet_grip(const GripScene& scene, const StoredGrasp& grasp,
                                  const GripOptions& options, const BulletOptions& bullet);

}  // namespace clench::bench
