// Differences between two worlds that a file format could not store.
#pragma once
#include <string>
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// Phrases such as "the mass of 'mug'", "the name 'cup'" for differences beyond the rounding of a
/// file with all digits: 1e-12 of a meter, of a radian, or of the value. Free bodies, robots and
/// their parts are matched by their order.
std::vector<std::string> differences(const World& world, const World& other);

}  // namespace clench
