// Options of make_scene.
#pragma once
#include <optional>
#include <vector>

#include "clench/model/world.h"
#include "clench/scene/eye.h"

namespace clench {

/// Sizes of friction cones: separate cones, each lowered if its neighbors are near; equal cones; or
/// heights in proportion to the friction coefficient or to the normal force, the largest of the
/// given size.
enum class ConeSizes { apart, equal, friction, force };

/// The normal force at a contact, identified by its point.
struct ContactLoad {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  double force = 0;                               ///< [N]
};

/// Content that a computed view must hold: everything, or, if robots touch objects, those objects
/// and the parts of those robots from the palm outward.
enum class Framing { contacts, all };

struct SceneOptions {
  bool contacts = true;  ///< draw friction cones at the contacts of robots with objects
  bool patches = false;  ///< draw the patches of all soft contacts
  /// draw an arrow from the approach point of each closing robot, along its direction
  bool approach = false;
  bool ground = true;  ///< a floor under the lowest point, unless an obstacle is the floor
  /// height of that floor [m]; empty: that of the lowest point
  std::optional<double> ground_height = {};
  bool transparent_objects = true;  ///< which leaves contacts visible
  ConeSizes cone_sizes = ConeSizes::apart;
  /// height of the highest cone [m]; 0: 0.15 of the object's largest radius
  double cone_height = 0;
  /// for ConeSizes::force; contacts without a load have no cone
  std::vector<ContactLoad> loads = {};
  Framing framing = Framing::contacts;
  bool file_colors = true;  ///< colors of the files, if they give any; otherwise by kind of body
  /// draw links transparent, which shows what is in and behind them
  std::vector<Id<Robot>> see_through = {};
  std::optional<Eye> eye = {};
};

}  // namespace clench
