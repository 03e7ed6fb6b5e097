// The six-direction force test of a grasp given as numbers, in any engine.
#pragma once
#include <array>

#include "bench/verdicts/grip_scene.h"

namespace clench::bench {

struct GripOptions {
  // of the servos that hold the posture [N m/rad]; 100 times that for prismatic joints [N/m]
  double kp = 5;
  double grip_seconds = 0.5, settle = 1, seconds = 2;
  double max_distance = 0.05, max_angle = 0.2617993877991494;  // [m, rad]
};

/// The object is at rest in the hand, without gravity. Servos hold the joints at the grasp's
/// posture.
class Grip {
 public:
  virtual ~Grip() = default;
  virtual double step_length() const = 0;  // [s]
  /// share  fraction of the grasp's torques that act; force  at the object's center of mass [N]
  virtual void step(double share, const Eigen::Vector3d& force) = 0;
  virtual Eigen::Isometry3d pose() const = 0;  // of the object's frame
  virtual int contacts() = 0;                  // number of contact points with the hand
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
  int held = 0;                       // number of directions
  double moved = 0, turned = 0;       // during the grip [m, rad]
  std::array<PushVerdict, 6> pushes;  // along +x, -x, +y, -y, +z, -z
};

/// The grasp's torques increase within grip_seconds, and all bodies come to rest. From this state,
/// for each direction, the scene's force pushes the object's center of mass along an axis of its
/// frame. The object is held if its displacement from the pose at rest stays within the limits of
/// the options.
GripVerdict shake(Grip& grip, const GripScene& scene, const GripOptions& options);

}  // namespace clench::bench
