// Hashes that identify shapes, bodies and robots by the content on which grasps depend, regardless
// of names, files and poses.
#pragma once
#include <cstdint>

#include "clench/model/world.h"

namespace clench {

/// Fingerprint of a surface; it does not depend on the order of triangles and vertices.
uint64_t fingerprint(const Shape& shape);

/// Fingerprint of surface, mass, center of mass, inertia, material, elasticity, restitution,
/// damping of free motion and gravity compensation.
uint64_t fingerprint(const World& world, Id<Body> id);

/// Fingerprint of the bodies of base and links, of joints, DOFs, limits and motors, of the number
/// of joint tendons and of the approach frame. The posture is ignored.
uint64_t fingerprint(const World& world, Id<Robot> id);

}  // namespace clench
