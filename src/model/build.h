// A world from its description.
#pragma once
#include "model/world.h"

namespace clench {

/// Bodies and robots in the file's order. A carried robot keeps the pose that its block gives when this
/// agrees with the connection (files hold six digits); otherwise the connection wins.
World build_world(const WorldSpec& spec);

}  // namespace clench
