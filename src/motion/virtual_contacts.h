// Virtual contacts of a hand that brings none: places on the side of its links that closes.
#pragma once
#include "clench/model/find.h"

namespace clench {

struct FindSitesOptions {
  int count_per_link = 1;  ///< places on each link, along its length, 1 to 100
  bool palm = true;        ///< one on the palm, too
  /// material that is to be grasped: gives mu with the link's own
  std::string object_material = "wood";
};

/// Where surfaces move forward when the hand closes. The hand is open and every DOF moves at its
/// default velocity; a piece of surface counts as much as the volume that it sweeps, area times
/// speed along its outward normal. A link's place is the center of what it sweeps, brought onto the
/// surface against the mean normal; several are the centers of equal shares along the link's
/// length. The normal is that of the surface around. The palm, which is the base or the link that
/// stays where it is and lies nearest to the approach point, counts as moving along the approach
/// direction, and its place lies at that point, when there is surface. Frames are contact frames;
/// each has the 8 edges of a point.
///
/// returns  chain by chain, the palm last; nothing for links that do not move, or without geometry,
///          and nothing at all for robots whose DOFs all have default velocity 0
/// throws   Error when an option is out of range or a material is unknown
std::vector<VirtualContactSpec> find_virtual_contacts(const World& world, Id<Robot> robot,
                                                      const FindSitesOptions& options = {});

/// The robot's own virtual contacts, or, when it was never given any, those that are found.
std::vector<VirtualContactSpec> virtual_contacts(const World& world, Id<Robot> robot);

/// A real contact of the robot as a virtual one, on its side.
/// throws  Error when neither body is its base or a link
VirtualContactSpec marked(const World& world, Id<Robot> robot, const Contact& contact);

}  // namespace clench
