// Objects that move with another body as one piece for a time.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// From now on the object, with all that is welded to it, stays as it stands to the other body: in
/// runs it moves as if it were a part of it. Their momentum stays: what moved differently before
/// moves together afterwards. Placed by hand, they are welded as they then stand.
/// object  a free body that is welded to nothing
/// to      any other body, which does not hang on the object by welds
/// throws  Error
void weld(World& world, Id<Body> object, Id<Body> to);
/// It goes on with the velocity that it had as a part.
void unweld(World& world, Id<Body> object);

}  // namespace clench
