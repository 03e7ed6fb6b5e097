#include "clench/io/mjcf_write/written_carriage.h"

#include <algorithm>
#include <cmath>

namespace clench {

// natural frequency of the servos, critically damped and as stiff as those of a robot arm [rad/s]
static constexpr double carriage_frequency = 200;
// a base with smaller rotations has only slides [rad]
static constexpr double min_rotation = 1e-9;

static constexpr const char* axis_names[] = {"carriage_x",    "carriage_y",     "carriage_z",
                                             "carriage_roll", "carriage_pitch", "carriage_yaw"};

std::vector<double> Carriage::coordinates(const Pose& X) const {
  const Eigen::Vector3d p = X.position - X_WB.position;
  std::vector<double> out = {p.x(), p.y(), p.z()};
  if (axes.size() <= 3) return out;
  // R = Rx(a) Ry(b) Rz(c), each about the axis as turned by those before it
  const Eigen::Matrix3d R = (X_WB.rotation.conjugate() * X.rotation).toRotationMatrix();
  out.push_back(std::atan2(-R(1, 2), R(2, 2)));
  out.push_back(std::atan2(R(0, 2), std::hypot(R(0, 0), R(0, 1))));
  out.push_back(std::atan2(-R(0, 1), R(0, 0)));
  return out;
}

// mass, center of mass and inertia about the base of all bodies that the carriage moves
static CarriageAxis with_servo(CarriageAxis axis, const WrittenScene& scene, int base,
                               const Eigen::Vector3d& gravity) {
  const Pose& X = scene.bodies[static_cast<size_t>(base)].X_WB;
  const Eigen::Vector3d a = X.rotation * axis.axis_B;
  double inertia = 0, weight = 0;
  for (size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.is_below(static_cast<int>(b), base)) continue;
    const WrittenBody& body = scene.bodies[b];
    const BodySpec& spec = *body.spec;
    const Eigen::Vector3d v =
        axis.turns ? Eigen::Vector3d(a.cross(body.X_WB * com_of(spec) - X.position)) : a;
    const Eigen::Vector3d w = body.X_WB.rotation.conjugate() * a;
    inertia += spec.mass * (v.squaredNorm() + (axis.turns ? w.dot(inertia_of(spec) * w) : 0));
    weight += spec.mass * gravity.dot(v);
  }
  axis.kp = inertia * carriage_frequency * carriage_frequency;
  axis.kd = 2 * inertia * carriage_frequency;
  axis.hold = -weight;
  return axis;
}

Carriage plan_carriage(const SceneRequest& request, const WrittenScene& scene) {
  Carriage out;
  if (request.carriage < 0) return out;
  const int base = scene.parts[static_cast<size_t>(request.carriage)].front();
  out.X_WB = scene.bodies[static_cast<size_t>(base)].X_WB;
  const bool turns = std::ranges::any_of(request.keys, [&](const WrittenKey& key) {
    const Pose& X = key.robots[static_cast<size_t>(request.carriage)];
    return out.X_WB.rotation.angularDistance(X.rotation) > min_rotation;
  });
  const Eigen::Vector3d gravity =
      request.world.gravity.value_or(Eigen::Vector3d(0, 0, -standard_gravity));
  for (int i = 0; i < (turns ? 6 : 3); ++i) {
    CarriageAxis axis;
    axis.name = axis_names[i];
    axis.turns = i >= 3;
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(i % 3);
    axis.axis_B = axis.turns ? unit : Eigen::Vector3d(out.X_WB.rotation.conjugate() * unit);
    out.axes.push_back(with_servo(std::move(axis), scene, base, gravity));
  }
  return out;
}

}  // namespace clench
