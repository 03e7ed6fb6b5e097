#include "bench/verdicts/grip_test.h"

#include <algorithm>
#include <cmath>

namespace clench::bench {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

struct Displacement {
  double moved, turned;
};

Displacement between(const Isometry3d& from, const Isometry3d& to, const Vector3d& com) {
  const Eigen::AngleAxisd turn(from.linear().transpose() * to.linear());
  return {(to * com - from * com).norm(), std::abs(turn.angle())};
}

}  // namespace

GripVerdict shake(Grip& grip, const GripScene& scene, const GripOptions& options) {
  GripVerdict out;
  const auto steps = [&](double seconds) { return int(std::lround(seconds / grip.step_length())); };
  const auto lost = [&](const Displacement& d) {
    return !(d.moved <= options.max_distance && d.turned <= options.max_angle);
  };
  const Isometry3d start = grip.pose();
  for (int i = 1; i <= steps(options.grip_seconds); ++i)
    grip.step(double(i) / steps(options.grip_seconds), Vector3d::Zero());
  const Isometry3d pressed = grip.pose();
  for (int i = 0; i < steps(options.settle); ++i) grip.step(1, Vector3d::Zero());
  const Isometry3d rest = grip.pose();
  const Displacement all = between(start, rest, scene.object.com);
  out.moved = all.moved, out.turned = all.turned;
  out.settled = !lost(between(pressed, rest, scene.object.com)) && grip.contacts() > 0;
  if (!out.settled) return out;
  grip.save();
  for (int d = 0; d < 6; ++d) {
    grip.restore();
    const Isometry3d from = grip.pose();
    const Vector3d force = (d % 2 == 0 ? 1 : -1) * scene.force * Vector3d::Unit(d / 2);
    PushVerdict& push = out.pushes[d];
    push.held = true;
    for (int i = 0; push.held && i < steps(options.seconds); ++i) {
      grip.step(1, force);
      const Displacement by = between(from, grip.pose(), scene.object.com);
      push.moved = std::max(push.moved, by.moved), push.turned = std::max(push.turned, by.turned);
      push.held = !lost(by);
    }
    out.held += push.held;
  }
  out.survived = out.held == 6;
  return out;
}

}  // namespace clench::bench
