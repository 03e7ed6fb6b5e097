// The six-direction force test in Bullet: its own collisions of convex pieces, its own reduced coordinates, its own solver.
#pragma once
#include "bench/verdicts/grip_scene.h"

namespace clench::bench {

struct BulletGripOptions {
  double step = 0.0005;              // [s]
  double kp = 5, kd = 0.1;           // of the servos that hold the posture [N m/rad, N m s/rad]; 100 times that for joints that slide
  int iterations = 50;
  double grip_seconds = 0.5, settle = 1, seconds = 2;
  double max_distance = 0.05, max_angle = 0.2617993877991494;  // [m, rad]
};

struct BulletVerdict {
  bool survived = false, settled = false;
  int held = 0;
  double depth = 0;                 // of the deepest contact where the grasp begins, in these shapes [m]
  double moved = 0, turned = 0;     // until the hand held it [m, rad]
};

/// The object rests in the hand, free of gravity, while joints are held by servos and the grasp's torques are added within grip_seconds; then, each time from
/// where all has come to rest, the scene's force pushes its centre of mass along an axis of the object's frame.
BulletVerdict shake_in_bullet(const GripScene& scene, const StoredGrasp& grasp, const BulletGripOptions& options);

}  // namespace clench::bench
