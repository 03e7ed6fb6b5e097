// What a picture of a grasp has to show.
#pragma once
#include <set>
#include <span>

#include "clench/model/find.h"
#include "clench/model/world.h"

namespace clench {

/// The objects that robots touch, and of each of these robots the part that holds them: the links
/// from its palm outward, never its base. The palm is the last link that carries all links that
/// touch and has two branches that move; without one, all links count.
std::set<Id<Body>> touched_bodies(const World& world, std::span<const Contact> contacts);

}  // namespace clench
