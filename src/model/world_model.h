// The parts of a world: its bodies and robots, its settings, and its current state.
#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "clench/contact/materials.h"
#include "clench/model/dynamic_settings.h"
#include "clench/model/dynamic_state.h"
#include "clench/model/robot.h"
#include "clench/model/slot.h"
#include "clench/spec/world_spec.h"

namespace clench {

using BodyPair = std::pair<Id<Body>, Id<Body>>;
/// Every query runs on a pair in one order, so that (a, b) and (b, a) give the same bits.
inline BodyPair ordered(Id<Body> a, Id<Body> b) { return std::minmax(a, b); }

/// Bodies and robots. Clones and snapshots share it; a world copies it before a change if it is
/// shared.
struct WorldModel {
  std::vector<Slot<Body>> bodies;
  std::vector<Slot<Robot>> robots;
  std::vector<Id<Body>> body_order;  ///< alive, in creation order
  std::vector<Id<Robot>> robot_order;
  std::string source;
  std::map<std::string, int> counts;  ///< number of names generated from a name
  /// Ids by name; an empty id: no body or robot has the name now.
  std::map<std::string, Id<Body>, std::less<>> body_names;
  std::map<std::string, Id<Robot>, std::less<>> robot_names;

  uint64_t stamp = 0;  ///< changes with every change, uniquely in all worlds of a family

  size_t bytes() const;  ///< approximate memory, without meshes, which are shared
};

/// A named state. Bodies that were removed are omitted.
using Keyframe = KeyframeOf<Id<Body>, Id<Robot>>;

/// Settings of the world; shared in the same way as the model.
struct WorldSettings {
  MaterialTable materials;
  double contact_threshold = 1e-4;  ///< [m]
  bool collision_on = true;
  std::set<Id<Body>> switched_off;  ///< bodies that collide with nothing
  std::set<BodyPair> pairs_off;     ///< pairs as returned by ordered()
  /// Collision bits of bodies, and the robots to which these belong.
  std::map<Id<Body>, std::pair<CollisionBits, Id<Robot>>> collision_bits;
  std::set<BodyPair> pairs_on;  ///< pairs that collide regardless of their bits
  std::optional<Camera> camera;
  Eigen::Vector3d gravity{0, 0, -standard_gravity};             ///< in the world frame [m/s^2]
  std::vector<Keyframe> keyframes;                              ///< with different names
  std::map<std::string, size_t, std::less<>> keyframe_numbers;  ///< indices in keyframes, by name
  DynamicSettings dynamics;
  uint64_t stamp = 0;  ///< like that of the model

  /// do the settings permit it?
  bool may_collide(Id<Body> a, Id<Body> b) const {
    return collision_on && !switched_off.contains(a) && !switched_off.contains(b) &&
           !pairs_off.contains(ordered(a, b)) && !bits_keep_apart(a, b);
  }
  bool bits_keep_apart(Id<Body> a, Id<Body> b) const {
    if (collision_bits.empty()) return false;
    const auto x = collision_bits.find(a), y = collision_bits.find(b);
    if (x == collision_bits.end() || y == collision_bits.end()) return false;
    const auto& [bits_a, robot_a] = x->second;
    const auto& [bits_b, robot_b] = y->second;
    return !(robot_a && robot_a == robot_b) && bits_a.keeps_apart(bits_b) &&
           !pairs_on.contains(ordered(a, b));
  }
  size_t bytes() const;
};

/// Current state in flat arrays. Entries of removed bodies and robots remain.
struct WorldState {
  std::vector<Pose> X_WB;      ///< by the index of the body's id
  std::vector<double> dofs;    ///< of all robots, from Robot::first_dof on [rad or m]
  std::vector<double> joints;  ///< q, from Robot::first_joint on [rad or m]
  /// per joint: true if it is engaged, and at the value given by its DOF
  std::vector<unsigned char> follows_dof;
  /// null until something moves: everything is at rest, and the time is 0. It is copied before a
  /// change if it is shared.
  std::shared_ptr<DynamicState> dynamics;

  /// reserves memory so that copying the other state allocates nothing
  void reserve_for(const WorldState& other);
  size_t bytes() const;
};

/// State, model and settings of a world at one time.
struct Snapshot {
  /// the same for a world and all its direct and indirect clones
  std::shared_ptr<const void> lineage;
  std::shared_ptr<const WorldModel> model;
  std::shared_ptr<const WorldSettings> settings;
  WorldState state;

  /// Approximate memory of which it may be the last owner.
  size_t bytes() const { return model->bytes() + settings->bytes() + state.bytes(); }
};

}  // namespace clench
