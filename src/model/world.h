// The World owns every mutable thing: bodies, robots, collision settings, friction. It is used by
// one thread; copy it for another. A copy shares what neither changes from then on.
#pragma once
#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "clench/model/query_context.h"

namespace clench {

class World {
 public:
  // --- things ---
  // Poses are copied, as references returned by pose() become invalid when the world grows.
  /// `name` empty: the spec's, made unique by a number.
  /// throws  Error if the name is taken
  Id<Body> add_body(const BodySpec& spec, BodyKind kind, Pose X_WB, const std::string& name = "");
  Id<Robot> add_robot(const RobotSpec& spec, Pose X_WB, const std::string& name = "");
  /// Attaches `child` to a link of the parent.
  /// throws  Error if that closes a cycle, the link does not exist, or the child is carried already
  void mount(Id<Robot> child, Id<Robot> parent, int link, Pose X_LB,
             const BodySpec* piece = nullptr);
  /// Detaches it; it stays where it is, and its adapter is removed.
  /// throws  Error if it is not carried
  void unmount(Id<Robot> child);
  /// an object or obstacle
  /// throws  Error for a part of a robot
  void remove(Id<Body> body);
  /// with base, links and mount; robots that it carries stay where they are
  void remove(Id<Robot> robot);

  const std::vector<Id<Body>>& bodies() const { return model_->body_order; }
  const std::vector<Id<Robot>>& robots() const { return model_->robot_order; }
  /// throws Error "body 'flask' was removed from its world" if stale
  const Body& body(Id<Body> id) const;
  const Robot& robot(Id<Robot> id) const;
  bool alive(Id<Body> id) const;
  bool alive(Id<Robot> id) const;
  /// empty if there is none
  Id<Body> find_body(std::string_view name) const;
  Id<Robot> find_robot(std::string_view name) const;
  /// base, links, mount
  std::vector<Id<Body>> bodies_of(Id<Robot> robot) const;

  // --- state ---
  const Pose& pose(Id<Body> id) const { return body(id), state_.X_WB[id.index]; }
  using Values = Eigen::Map<const Eigen::VectorXd>;
  Values dofs(Id<Robot> id) const;    ///< one per DOF [rad or m]
  Values joints(Id<Robot> id) const;  ///< q of each [rad or m]
  /// Is the joint where its DOF puts it? One that has left a breakaway DOF is not, nor one that is
  /// held against its spring.
  bool follows_dof(Id<Robot> robot, int joint) const;
  /// One per joint: its q if it does not follow its DOF.
  std::vector<JointPosition> own_joint_positions(Id<Robot> robot) const;
  /// In the world frame.
  RobotFrames frames(Id<Robot> robot) const;

  /// of an object or obstacle
  /// throws  Error for a part of a robot or a pose that is not finite
  void set_pose(Id<Body> body, const Pose& X_WB);
  /// of the base; links and carried robots follow
  /// throws  Error if the robot is carried
  void set_pose(Id<Robot> robot, const Pose& X_WB);
  /// All joints follow them.
  /// throws  Error for a wrong count or a number that is not finite; values outside the limits are
  ///         rejected by name
  void set_dofs(Id<Robot> robot, const Eigen::VectorXd& q);
  /// Base and DOFs at once, for searches; DOFs outside their limits are set to the nearest one.
  /// throws  Error if the robot is carried, for a wrong count, or if something is not finite;
  ///         nothing moves then
  void set_posture(Id<Robot> robot, const Pose& X_WB, const Eigen::VectorXd& q);
  /// The same, with joints that do not follow; used by motion, which has its own checks.
  /// apart  one per joint
  void set_dofs_unchecked(Id<Robot> robot, const Eigen::VectorXd& q,
                          std::span<const JointPosition> own);

  // --- properties of things ---
  /// null: each DOF has its own
  /// throws  Error as check_eigengrasps does, or if the set is for another number of DOFs
  void set_eigengrasps(Id<Robot> robot, std::shared_ptr<const EigengraspSet> set);
  /// null: none given
  /// throws  Error as check_virtual_contact does, or if one lies on a link that does not exist
  void set_virtual_contacts(Id<Robot> robot,
                            std::shared_ptr<const std::vector<VirtualContactSpec>> contacts);
  void set_name(Id<Body> body, const std::string& name);
  void set_material(Id<Body> body, std::string_view material);
  void set_mass(Id<Body> body, double mass);
  /// An inertia that was computed from the body's shape is computed again about it, one that was
  /// given is unchanged.
  void set_com(Id<Body> body, const Eigen::Vector3d& com);
  void set_inertia(Id<Body> body, const Eigen::Matrix3d& inertia);  ///< about com [kg m^2]
  void set_elastic_modulus(Id<Body> body, std::optional<double> modulus);
  void set_soft_layer(Id<Body> body, double height);     ///< > 0 [m]
  void set_restitution(Id<Body> body, double ratio);     ///< in [0, 1]
  void set_poisson_ratio(Id<Body> body, double ratio);   ///< in [0, 0.5)
  void set_free_damping(Id<Body> body, double damping);  ///< as in BodySpec, >= 0
  void set_free_friction(Id<Body> body, double friction);
  void set_free_armature(Id<Body> body, double armature);
  void set_gravity_compensation(Id<Body> body, double part);
  void set_appearance(Id<Body> body, const Appearance& appearance);
  /// Makes an object an obstacle, or an obstacle an object; it comes to rest.
  /// throws  Error for a part of a robot, another kind, or an object that is welded to another one
  void set_kind(Id<Body> body, BodyKind kind);

  const MaterialTable& materials() const { return settings_->materials; }
  /// Adds the material with this friction, unless a material has its name.
  void add_friction(const OwnFriction& own);
  void set_friction(std::string_view a, std::string_view b, Friction friction) {
    edit_settings().materials.set_friction(a, b, friction);
  }
  double contact_threshold() const { return settings_->contact_threshold; }
  /// throws Error as contact_threshold_rule
  void set_contact_threshold(double threshold);
  const std::optional<Camera>& camera() const { return settings_->camera; }
  void set_camera(const std::optional<Camera>& camera);
  const Eigen::Vector3d& gravity() const { return settings_->gravity; }
  /// throws Error as gravity_rule
  void set_gravity(const Eigen::Vector3d& gravity);
  const std::string& source() const { return model_->source; }
  void set_source(const std::string& source) { edit_model().source = source; }

  // --- dynamics ---
  // Placing things by the functions above also sets their velocities to zero.
  const DynamicSettings& dynamic_settings() const { return settings_->dynamics; }
  /// throws Error for an invalid number
  void set_dynamic_settings(DynamicSettings settings);
  /// null: all is at rest, and the time is 0
  const DynamicState* dynamics() const { return state_.dynamics.get(); }
  /// Its arrays have an entry for everything in the world; new DOFs hold their present position.
  DynamicState& edit_dynamics();
  double time() const { return state_.dynamics ? state_.dynamics->time : 0; }
  Twist twist(Id<Body> id) const;
  /// velocity of a body that is a part of another
  Twist carried_twist(Id<Body> body, Id<Body> carrier) const;
  /// Sets the velocity of an object, of an obstacle, which moves with it from then on, or of a
  /// robot's base.
  /// throws  Error for a link or a value that is not finite
  void set_twist(Id<Body> id, const Twist& twist);
  DofControl control(Id<Robot> robot, int dof) const;
  Eigen::VectorXd dof_velocities(Id<Robot> id) const;
  /// throws  Error for a wrong count or a number that is not finite
  void set_dof_velocities(Id<Robot> id, const Eigen::VectorXd& velocities);
  /// For steps: velocities and all other state are unchanged. Only the validity of the pose is
  /// checked.
  void drift(Id<Body> body, const Pose& X_WB);
  /// joints  all, including those that do not follow their DOF
  void drift(Id<Robot> robot, const Pose& X_WB, std::span<const double> dofs,
             std::span<const double> joints);
  void set_follows_dof(Id<Robot> robot, int joint, bool follows);

  // --- collision settings ---
  void set_collision(bool on);                          ///< the complete world
  void set_collision(bool on, Id<Body> body);           ///< one body against everything
  void set_collision(bool on, Id<Body> a, Id<Body> b);  ///< a pair
  bool may_collide(Id<Body> a, Id<Body> b) const;
  /// Pairs that set_collision() enables later collide whatever their bits.
  void set_collision_bits(Id<Body> body, const CollisionBits& bits);
  /// All disabled pairs, including those separated by bits, in their order.
  /// throws Error if there are more than max_pairs_off
  std::vector<BodyPair> pairs_off() const;
  static constexpr size_t max_pairs_off = 2'000'000;

  // --- named states ---
  const std::vector<Keyframe>& keyframes() const { return settings_->keyframes; }
  /// Replaces one of the same name.
  /// throws Error for an invalid name or pose, a stale id, or DOFs outside their limits
  void add_keyframe(Keyframe keyframe);
  /// The present poses of all bodies and robots as a keyframe.
  Keyframe current_keyframe(const std::string& name) const;
  /// Moves all bodies and robots in the keyframe, except those that were removed or are carried.
  /// throws Error for an unknown name, which lists the names
  void set_keyframe(std::string_view name);

  // --- snapshots ---
  std::shared_ptr<const Snapshot> snapshot() const;
  /// Restores the exact state of the snapshot, which was taken of this world, of a clone of it, or
  /// of one that this is a clone of: what was removed since is restored, what was added since is
  /// removed.
  /// throws Error if it was taken of an unrelated world
  void restore(const Snapshot& snapshot);
  /// the same object for a world and all its clones
  std::shared_ptr<const void> lineage() const { return lineage_; }
  const WorldModel& model() const { return *model_; }
  const WorldSettings& settings() const { return *settings_; }
  /// Fingerprint of poses, DOFs, masses, materials, switches: equal for equal bits.
  uint64_t hash() const;
  /// Is one a clone of the other, or do both have a common ancestor?
  bool is_related(const World& other) const { return lineage_ == other.lineage_; }
  size_t bytes() const;  ///< memory in use, approximately

  /// Context of the thread that owns the world; not copied.
  QueryContext& context() { return scratch_.context; }

 private:
  static std::string the_body(const std::string& name);  ///< "body 'flask'", for sentences
  WorldModel& edit_model();
  WorldSettings& edit_settings();
  Body& edit(Id<Body> id);
  Robot& edit(Id<Robot> id);
  uint32_t next_serial() { return ++lineage_->serials; }
  Id<Body> insert(Body body, Pose X_WB, const std::string& name);
  Id<Robot> insert(Robot robot);
  void add_start_state(Robot& robot);
  void check_name_is_free(const std::string& name) const;
  std::string unique_name(const std::string& expected);
  void switch_off_neighbors(const Robot& robot, bool chain_links_collide);
  void add_parts(Id<Robot> id, const RobotSpec& spec, const Pose& X_WB);
  void erase(Id<Body> id);
  /// without its parts
  void erase(Id<Robot> id);
  /// throws Error if another robot carries it
  void check_free(Id<Robot> robot) const;
  /// Poses of links for the present base and joints; a step computes them anew.
  void update_link_twists(Id<Robot> robot);
  void carry_welded();
  DofControl first_control(const Robot& robot, size_t dof) const;
  void come_to_rest(Id<Body> body);
  /// including all that it carries
  void come_to_rest(Id<Robot> robot);
  /// Its motors hold its DOFs in place, or exert nothing.
  void hold_dofs(Id<Robot> robot);
  void check_dof_count(Id<Robot> robot, const Eigen::VectorXd& q) const;
  /// A pose to be assigned to a robot's base, and to all that moves with it.
  void find_places(Id<Robot> robot, const Pose& X_WB);
  void set_joints(Id<Robot> robot, const Pose& X_WB, const Eigen::VectorXd& q,
                  std::span<const JointPosition> own);
  /// throws Error, and moves nothing, if one of the resulting poses is invalid
  void place(Id<Robot> robot, const Pose& X_WB);

  std::shared_ptr<WorldModel> model_ = std::make_shared<WorldModel>();
  std::shared_ptr<WorldSettings> settings_ = std::make_shared<WorldSettings>();
  WorldState state_;
  /// Shared by a world and all its clones: the last numbers that were assigned. They never
  /// decrease, so that a restored world cannot make a stale id valid.
  struct Lineage {
    std::atomic<uint32_t> serials = 0;
    std::atomic<uint64_t> stamps = 0;
  };
  std::shared_ptr<Lineage> lineage_ = std::make_shared<Lineage>();
  /// State that copies do not take over.
  struct Scratch {
    Scratch() = default;
    Scratch(const Scratch&) {}
    Scratch& operator=(const Scratch&) { return *this; }
    QueryContext context;
    std::vector<std::pair<Id<Body>, Pose>> places;
    std::vector<double> dofs, joints;
    std::vector<unsigned char> follows_dof;
    RobotFrames frames;
  };
  Scratch scratch_;
};

}  // namespace clench
