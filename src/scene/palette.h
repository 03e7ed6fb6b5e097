// All colors of pictures of worlds, in one table. Colors are display values (sRGB).
#pragma once
#include "clench/model/body.h"

namespace clench::palette {

struct Entry {
  Eigen::Vector3f color;
  float opacity;  ///< for transparent objects, which leave contacts visible
};

/// Colors by kind of body: dark palm and light fingers, which make the joints of a hand visible;
/// the only saturated color for objects; muted obstacles.
inline Entry of(BodyKind kind) {
  switch (kind) {
    case BodyKind::base:
      return {{0.29f, 0.33f, 0.38f}, 1};
    case BodyKind::link:
      return {{0.74f, 0.77f, 0.80f}, 1};
    case BodyKind::mount:
      return {{0.45f, 0.49f, 0.54f}, 1};
    case BodyKind::object:
      return {{0.25f, 0.60f, 0.85f}, 0.26f};
    case BodyKind::obstacle:
      return {{0.80f, 0.74f, 0.66f}, 1};
  }
  return {{0.7f, 0.7f, 0.7f}, 1};
}

/// Friction cones: the complement of the objects' color, which surrounds them.
inline const Eigen::Vector3f cone(1.0f, 0.29f, 0.0f);
/// Fitted surfaces of soft contacts, and the contact ellipses.
inline const Eigen::Vector3f patch(0.98f, 0.80f, 0.35f);
inline const Eigen::Vector3f ellipse(0.85f, 0.10f, 0.25f);
/// Cones of contacts without friction, which are needles.
inline const Eigen::Vector3f needle(0.95f, 0.80f, 0.10f);
/// Forces at contacts.
inline const Eigen::Vector3f force(0.55f, 0.10f, 0.60f);

/// Net forces and net torques on bodies.
inline const Eigen::Vector3f net_force(0.84f, 0.10f, 0.45f), net_torque(0.40f, 0.32f, 0.80f);

/// Ghosts of robots.
inline const Eigen::Vector3f ghost(0.10f, 0.55f, 0.45f);
inline constexpr float ghost_opacity = 0.32f;

/// Approach directions.
inline const Eigen::Vector3f approach(0.10f, 0.55f, 0.30f);

/// Wrench spaces: the solid, the ball inside it, the direction of the smallest reach.
inline const Eigen::Vector3f wrenches(0.25f, 0.60f, 0.85f), ball(1.0f, 0.55f, 0.10f),
    ball_label(0.60f, 0.28f, 0.0f), weakest(0.80f, 0.0f, 0.80f);
/// The x, y and z axes of a space.
inline const Eigen::Vector3f axes[3] = {
    {0.75f, 0.15f, 0.12f}, {0.10f, 0.52f, 0.18f}, {0.12f, 0.25f, 0.70f}};

}  // namespace clench::palette
