// Objects become obstacles, and obstacles objects.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Sets the kind of a body that is no part of a robot, which comes to rest. A welded object stays
/// one.
/// throws  Error for a part of a robot, another kind than object or obstacle, or a welded object
void set_kind(World& world, Id<Body> body, BodyKind kind);

}  // namespace clench
