// A world from its description.
#pragma once
#include <functional>

#include "model/world.h"

namespace clench {

/// Bodies and robots in the file's order. A carried robot keeps the pose that its block gives when this
/// agrees with the connection to the six digits that files hold; otherwise the connection wins. DOF values
/// outside their limits are brought to the nearest limit. `warn` is told of both.
World build_world(const WorldSpec& spec, const std::function<void(const std::string&)>& warn = {});

}  // namespace clench
