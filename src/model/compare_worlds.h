// What of a world another one does not have: what a file format could not hold.
#pragma once
#include <string>
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// Phrases such as "the mass of 'mug'", "the name 'cup'" for what differs by more than the rounding
/// of a file that holds all digits: 1e-12 of a metre, of a radian, or of the value. Free bodies,
/// robots and their parts are matched by their order.
std::vector<std::string> differences(const World& world, const World& other);

}  // namespace clench
