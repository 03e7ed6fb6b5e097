// Objects that move rigidly with another body for a time.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Welds the object, with all that is welded to it, to another body at their present relative pose:
/// runs move it as a part of that body. Momentum is conserved: if they moved differently before,
/// they move together afterwards. If they are placed from outside, they stay welded at the new
/// relative pose.
/// object  a free body that is not welded
/// to      any other body that is not welded to the object
/// throws  Error
void weld(World& world, Id<Body> object, Id<Body> to);
/// Ends the weld; the object keeps the velocity that it had.
void unweld(World& world, Id<Body> object);

}  // namespace clench
