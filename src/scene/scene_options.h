// Options of make_scene.
#pragma once
#include <optional>
#include <vector>

#include "clench/model/world.h"
#include "clench/scene/eye.h"

namespace clench {

/// How large friction cones are: apart, each lowered where its neighbors are near; of one size; or
/// their heights in proportion to the friction coefficient or to the normal force, the largest of
/// that size.
enum class ConeSizes { apart, equal, friction, force };

/// The normal force at a contact, by its place.
struct ContactLoad {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  double force = 0;                               ///< [N]
};

/// Content that a chosen view must hold: everything, or, where robots touch objects, those objects
/// and the parts of those robots from the palm outward.
enum class Framing { contacts, all };

struct SceneOptions {
  bool contacts = true;  ///< draw friction cones at the contacts of robots with objects
  bool patches = false;  ///< draw the patches of all soft contacts
  /// draw an arrow from the approach point of each robot that closes, along its direction
  bool approach = false;
  bool ground = true;  ///< a floor under the lowest point, unless an obstacle is the floor
  std::optional<double> ground_height = {};  ///< of that floor [m]; empty: of the lowest point
  bool transparent_objects = true;           ///< so that contacts show
  ConeSizes cone_sizes = ConeSizes::apart;
  double cone_height = 0;  ///< of the highest cone [m]; 0: 0.15 of the object's largest radius
  std::vector<ContactLoad> loads = {};  ///< for ConeSizes::force; contacts without one have no cone
  Framing framing = Framing::contacts;
  bool file_colors = true;  ///< colors of the files, where they give any; else by kind of body
  std::vector<Id<Robot>> see_through = {};  ///< what is in and behind their links shows
  std::optional<Eye> eye = {};
};

}  // namespace clench
