// Contacts, objects and parts of robots that a picture of a grasp shows.
#pragma once
#include <set>
#include <span>
#include <vector>

#include "clench/model/find.h"
#include "clench/model/world.h"

namespace clench {

/// All contacts of parts of robots with objects.
std::vector<Contact> contacts_on_objects(const World& world);

/// The objects that robots touch, and of each of these robots the part that holds them: the links
/// from its palm outward. The palm is the last link that carries all touching links and has two
/// moving branches; if it has no surface, the body that it is fixed to takes its place. Without
/// such a link, the palm is the base, and the complete robot counts.
std::set<Id<Body>> touched_bodies(const World& world, std::span<const Contact> contacts);

}  // namespace clench
