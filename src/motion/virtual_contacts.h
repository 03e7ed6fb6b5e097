// Computes virtual contacts of a hand whose file has none: points on the closing side of its links.
#pragma once
#include "clench/model/find.h"

namespace clench {

struct FindSitesOptions {
  int count_per_link = 1;  ///< points on each link, along its length, 1 to 100
  bool palm = true;        ///< add one on the palm?
  /// material of the grasped object: gives mu with the link's own
  std::string object_material = "wood";
};

/// Contacts at the surfaces that move forward when the hand closes. The hand is open and every DOF
/// moves at its default velocity; a piece of surface is weighted by the volume that it sweeps per
/// unit of time, area times speed along its outward normal. The point of a link is the center of
/// its swept volume, projected onto the surface against the mean normal; several points are the
/// centers of parts of equal swept volume along the link's length. The normal is averaged over the
/// surrounding surface. The palm, which is the base or the link that does not move and is nearest
/// to the approach point, is treated as moving along the approach direction, and its contact is at
/// that point, if there is surface. Frames are contact frames; each has the 8 edges of a point
/// contact.
///
/// returns  chain by chain, the palm last; none for links that do not move or have no geometry, and
///          empty for robots whose DOFs all have default velocity 0
/// throws   Error if an option is out of range or a material is unknown
std::vector<VirtualContactSpec> find_virtual_contacts(const World& world, Id<Robot> robot,
                                                      const FindSitesOptions& options = {});

/// The robot's own virtual contacts, or, if it has none, the computed ones.
std::vector<VirtualContactSpec> virtual_contacts(const World& world, Id<Robot> robot);

/// A real contact of the robot as a virtual one, on its side.
/// throws  Error if neither body is its base or a link
VirtualContactSpec marked(const World& world, Id<Robot> robot, const Contact& contact);

}  // namespace clench
