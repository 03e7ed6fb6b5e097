// The World owns every mutable thing: bodies, robots, what may collide with what, friction.
// It is used by one thread; copy it for another. A copy shares the meshes and nothing else.
#pragma once
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "contact/materials.h"
#include "geometry/queries.h"
#include "model/robot.h"

namespace clench {

/// A place for a T and the serial number of who sits there.
template <class T>
struct Slot {
  uint32_t serial = 0;
  bool used = false;
  T value;  ///< of the last occupant; its name outlives it, for errors
};

/// All state of a world as a value: what a snapshot keeps.
struct WorldState {
  std::vector<Slot<Body>> bodies;
  std::vector<Slot<Robot>> robots;
  std::vector<Id<Body>> body_order;  ///< alive, in creation order
  std::vector<Id<Robot>> robot_order;
  MaterialTable materials;
  double contact_threshold = 1e-4;  ///< [m]
  bool collision_on = true;
  std::set<Id<Body>> switched_off;                    ///< bodies that collide with nothing
  std::set<std::pair<Id<Body>, Id<Body>>> pairs_off;  ///< lesser id first
  std::optional<Camera> camera;
  std::string source;
  std::map<std::string, int> counts;  ///< how often a name was numbered

  size_t bytes() const;  ///< that it takes, about; meshes, which are shared, left out
};

class World {
 public:
  // --- things ---
  /// `name` empty: the spec's, made unique by a number.
  /// throws  Error when the name is taken
  Id<Body> add_body(const BodySpec& spec, BodyKind kind, const Pose& X_WB,
                    const std::string& name = "");
  Id<Robot> add_robot(const RobotSpec& spec, const Pose& X_WB, const std::string& name = "");
  /// Carries `child` on a link of the parent from now on.
  /// throws  Error when that closes a circle, the link does not exist, or the child is carried
  ///         already
  void mount(Id<Robot> child, Id<Robot> parent, int link, const Pose& X_LB,
             const BodySpec* piece = nullptr);
  /// an object or obstacle
  /// throws  Error for a part of a robot
  void remove(Id<Body> body);
  /// with base, links and mount; robots that it carries stay where they are
  void remove(Id<Robot> robot);

  const std::vector<Id<Body>>& bodies() const { return state_.body_order; }
  const std::vector<Id<Robot>>& robots() const { return state_.robot_order; }
  /// throws Error "body 'flask' was removed from its world" when stale
  const Body& body(Id<Body> id) const;
  const Robot& robot(Id<Robot> id) const;
  bool alive(Id<Body> id) const;
  bool alive(Id<Robot> id) const;
  /// empty when there is none
  Id<Body> find_body(std::string_view name) const;
  Id<Robot> find_robot(std::string_view name) const;
  /// base, links, mount
  std::vector<Id<Body>> bodies_of(Id<Robot> robot) const;

  // --- state ---
  /// of an object or obstacle
  /// throws  Error for a part of a robot or a pose that is not finite
  void set_pose(Id<Body> body, const Pose& X_WB);
  /// of the base; links and carried robots follow
  /// throws  Error when the robot is carried
  void set_pose(Id<Robot> robot, const Pose& X_WB);
  /// throws  Error on a wrong count or a number that is not finite; values outside the limits are
  ///         refused by name
  void set_dofs(Id<Robot> robot, const Eigen::VectorXd& q);
  /// the same, with joints that do not follow; used by motion, which has its own checks
  void set_dofs_unchecked(Id<Robot> robot, const Eigen::VectorXd& q,
                          const std::vector<Apart>& apart);
  /// null: each DOF is its own
  /// throws  Error when check_eigengrasps does, or the set is for another number of DOFs
  void set_eigengrasps(Id<Robot> robot, std::shared_ptr<const EigengraspSet> set);
  /// null: none given
  /// throws  Error when check_virtual_contact does, or one lies on a link that does not exist
  void set_virtual_contacts(Id<Robot> robot,
                            std::shared_ptr<const std::vector<VirtualContactSpec>> contacts);
  void set_name(Id<Body> body, const std::string& name);
  void set_material(Id<Body> body, std::string_view material);
  void set_mass(Id<Body> body, double mass);
  /// An inertia that the body's shape gave is computed anew about it, one that was given stays.
  void set_com(Id<Body> body, const Eigen::Vector3d& com);
  void set_inertia(Id<Body> body, const Eigen::Matrix3d& inertia);  ///< about com [kg m^2]
  void set_elastic_modulus(Id<Body> body, std::optional<double> modulus);
  void set_soft_layer(Id<Body> body, double height);    ///< > 0 [m]
  void set_poisson_ratio(Id<Body> body, double ratio);  ///< in [0, 0.5)
  void set_appearance(Id<Body> body, const Appearance& appearance);

  const MaterialTable& materials() const { return state_.materials; }
  void set_friction(std::string_view a, std::string_view b, Friction friction) {
    state_.materials.set_friction(a, b, friction);
  }
  double contact_threshold() const { return state_.contact_threshold; }
  /// throws Error when contact_threshold_rule refuses it
  void set_contact_threshold(double threshold);
  const std::optional<Camera>& camera() const { return state_.camera; }
  void set_camera(const std::optional<Camera>& camera);
  const std::string& source() const { return state_.source; }
  void set_source(const std::string& source) { state_.source = source; }

  // --- what may collide ---
  void set_collision(bool on);                          ///< the whole world
  void set_collision(bool on, Id<Body> body);           ///< one body against everything
  void set_collision(bool on, Id<Body> a, Id<Body> b);  ///< a pair
  bool may_collide(Id<Body> a, Id<Body> b) const;

  // --- time machine ---
  std::shared_ptr<const WorldState> snapshot() const {
    return std::make_shared<WorldState>(state_);
  }
  /// Exactly the state of the snapshot: what was removed since is back, what was added since is
  /// gone.
  void restore(const WorldState& snapshot);
  const WorldState& state() const { return state_; }
  /// Fingerprint of poses, DOFs, masses, materials, switches: equal for equal bits.
  uint64_t hash() const;
  size_t bytes() const;  ///< that it takes, as its state's

  /// Coherence memory of a pair; changes no answer.
  PairCache& cache(Id<Body> a, Id<Body> b) const { return caches_[{a, b}]; }

 private:
  Body& edit(Id<Body> id);
  Robot& edit(Id<Robot> id);
  Id<Body> insert(Body body, const std::string& name);
  std::string unique_name(const std::string& expected);
  void switch_off_neighbours(const Robot& robot, bool chain_links_collide);
  void add_parts(Id<Robot> id, const RobotSpec& spec, const Pose& X_WB);
  void erase(Id<Body> id);
  using Places = std::vector<std::pair<Id<Body>, Pose>>;
  /// Where a robot's bodies, and those of robots that it carries, are when its base is at X_WB.
  void find_places(Id<Robot> robot, const Pose& X_WB, Places& out) const;
  /// throws Error, and moves nothing, when one of them would be no place
  void place(Id<Robot> robot, const Pose& X_WB);

  WorldState state_;
  uint32_t next_serial_ = 1;  // never goes back, so a restored world cannot revive a stale id
  mutable std::map<std::pair<Id<Body>, Id<Body>>, PairCache> caches_;
};

}  // namespace clench
