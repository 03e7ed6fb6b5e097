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
/// from its palm outward. The palm is the last link that carries all links that touch and has two
/// branches that move, with what is fixed to it where it has no surface; without such a link, it is
/// the base, and all of the robot counts.
std::set<Id<Body>> touched_bodies(const World& world, std::span<const Contact> contacts);

}  // namespace clench
