// The six-direction force test on a grasp as numbers, in any engine.
#pragma once
#include <array>

#include "bench/verdicts/grip_scene.h"

namespace clench::bench {

struct GripOptions {
  // of the servos that hold the posture [N m/rad]; 100 times that for joints that slide [N/m]
  double kp = 5;
  double grip_seconds = 0.5, settle = 1, seconds = 2;
  double max_distance = 0.05, max_angle = 0.2617993877991494;  // [m, rad]
};

/// The object rests in the hand, free of gravity. Servos hold the joints where the grasp has them.
class Grip {
 public:
  virtual ~Grip() = default;
  virtual double step_length() const = 0;  // [s]
  /// share  of the grasp's torques that act; force  at the object's center of mass [N]
  virtual void step(double share, const Eigen::Vector3d& force) = 0;
  virtual Eigen::Isometry3d pose() const = 0;  // of the object's frame
  virtual int contacts() = 0;                  // points where it touches the hand
  virtual void save() = 0;
  virtual void restore() = 0;
};

/// Largest displacement of the object under a force.
struct PushVerdict {
  bool held = false;
  double moved = 0, turned = 0;  // [m, rad]
};

struct GripVerdict {
  bool survived = false, settled = false;
  int held = 0;                       // in how many directions
  double moved = 0, turned = 0;       // until the hand held it [m, rad]
  std::array<PushVerdict, 6> pushes;  // along +x, -x, +y, -y, +z, -z
};

/// The grasp's torques are added within grip_seconds, and all comes to rest; then, each time from
/// there, the scene's force pushes the object's center of mass along an axis of its frame. It is
/// held where it is never farther from its pose at rest than the options allow.
GripVerdict shake(Grip& grip, const GripScene& scene, const GripOptions& options);

}  // namespace clench::bench
