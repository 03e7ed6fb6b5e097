// Identity of shapes, bodies and robots by their content: what grasps depend on, and nothing of names,
// files and poses.
#pragma once
#include <cstdint>

#include "clench/model/world.h"

namespace clench {

/// Of a surface: equal for surfaces of the same triangles and round solids, whatever the order of
/// triangles and the numbering of vertices.
uint64_t fingerprint(const Shape& shape);

/// Of surface, mass, center of mass, inertia, material and elasticity.
uint64_t fingerprint(const World& world, Id<Body> id);

/// Of its links' bodies, its joints, DOFs, limits, motors and tendons, and where it approaches. The
/// posture does not count.
uint64_t fingerprint(const World& world, Id<Robot> id);

}  // namespace clench
