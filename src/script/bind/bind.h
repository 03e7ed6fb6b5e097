// What the bindings share: the types that scripts hold, their classes and libraries, and how these
// are read and pushed.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clench/base/random.h"
#include "clench/contact/soft_patch.h"
#include "clench/geometry/tree/shape.h"
#include "clench/grasp/wrench/grasp.h"
#include "clench/grasp/wrench/kept_spaces.h"
#include "clench/grasp/wrench/projection.h"
#include "clench/model/find.h"
#include "clench/motion/drive.h"
#include "clench/motion/eigengrasps.h"
#include "clench/motion/move.h"
#include "clench/render/figure/drawing.h"
#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/scene/scene.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

// --- Libraries whose files say what they are for. ---

extern const Library units_library, vec3_library, pose_library, random_library, progress_library,
    log_library, parallel_library, job_library, json_library, catalog_library, convert_library,
    entries_library, files_library, arrays_library, film_library, chart_library, plot_library,
    render_library, eigengrasps_library, wrench_space_library, grasp_library, grasps_library,
    measures_library;

// --- clench.random: random numbers that are the same on every machine. ---

extern const Class random_class;

template <>
inline constexpr const Class* script_class<Random> = &random_class;

// --- progress: a bar for a script's own loops. ---

class Bar;

/// A loop of a script that is being shown.
struct ProgressHandle {
  std::shared_ptr<Bar> bar;
  double total = 1, done = 0;
  std::string text;
  bool open = true;

  ProgressHandle(std::shared_ptr<Bar> on, double of, std::string what);
  ProgressHandle(ProgressHandle&& from) noexcept;
  ~ProgressHandle() { close(); }
  void close();
};

extern const Class progress_class;

template <>
inline constexpr const Class* script_class<ProgressHandle> = &progress_class;

// --- job: a function that runs beside the script. ---

extern const Class job_class, this_job_class;

// --- The log: the only thing that prints unasked. To stderr, or to a script's function. ---

enum class LogLevel { debug, info, warning, error, quiet };

/// Tells the script's log, if its level lets the message through. May be called under the engine's
/// functions.
/// `about`  what a message of a file's reader tells: of what was "inferred", "ignored", "repaired"
///          or "suspicious"; null: of nothing such
/// throws  Raised when the script's own sink fails
void log(lua_State* L, LogLevel level, const std::string& message, const char* about = nullptr);

inline void log_warning(lua_State* L, const std::string& message) {
  log(L, LogLevel::warning, message);
}

/// Is this the first time in this state that it is asked about that?
/// key  a static thing whose address stands for it
bool first_time(lua_State* L, const void* key, const std::string& about);

/// Tells a warning, with the script's line, and never again in this state.
/// key  a static thing whose address stands for it
void warn_once(lua_State* L, const void* key, const std::string& message);

/// Warns once where a distance is beyond 10 m, for which millimeters are a likely cause.
/// subject  what lies there
void suspect_millimeters(lua_State* L, const std::string& subject, double distance);

LogLevel log_level(lua_State* L);
void set_log_level(lua_State* L, LogLevel level);

// --- mesh: the surface of a body, immutable. ---

extern const Class mesh_class;

template <>
inline constexpr const Class* script_class<ShapePtr> = &mesh_class;

inline size_t owned_bytes(const ShapePtr& shape) {
  return shape.use_count() == 1 ? shape->bytes() : 0;
}

// --- patch: the surfaces of two bodies around a soft contact, and the torsional friction that it
// transmits. ---

struct PatchHandle {
  std::shared_ptr<const SoftPatch> patch;
  Pose X_WA;
  bool body_is_b = false;  ///< of the contact that was asked: its body is the patch's b
  double mu = 0;
};

extern const Class patch_class;

template <>
inline constexpr const Class* script_class<PatchHandle> = &patch_class;

inline size_t owned_bytes(const PatchHandle& handle) {
  const auto& points = handle.patch->points;
  return sizeof(SoftPatch) + (points[0].size() + points[1].size()) * sizeof(Eigen::Vector3d);
}

/// "series" or "larger" of an option `modulus`
ModulusRule read_modulus_rule(Table& options);
/// as that takes it
const char* modulus_name(ModulusRule rule);

// --- contact: a point where one body touches another, as it was when it was asked for. ---

struct ContactHandle {
  WorldPtr world;
  Contact contact;
  std::shared_ptr<const SoftPatch> patch = nullptr;  ///< once it was asked for
};

extern const Class contact_class;

template <>
inline constexpr const Class* script_class<ContactHandle> = &contact_class;

/// A list of contacts.
int push_contacts(lua_State* L, const WorldPtr& world, const std::vector<Contact>& contacts);

// --- What bodies and robots have in common: material, mass, surface, color; a robot has those of
// its base. ---

extern const Class entity_class;

// --- body: an object, an obstacle or a part of a robot. ---

/// What a move came to: {fraction, touched, stopped_by, queries}.
int push_move(lua_State* L, const WorldPtr& world, const MoveResult& result);

// --- hand: what a robot has for grasping: eigengrasps, virtual contacts, a glove, sensors,
// tendons. ---

/// fields and methods of every robot
extern const Class hand_class;

/// {slopes, intercepts}
int push(lua_State* L, const GloveCalibration& glove);

/// What a drive came to: {moved, stops, stopped_by, queries, events}.
int push_drive(lua_State* L, const WorldPtr& world, const DriveResult& result);

// --- What every robot can do with its DOFs, and where they take its links. ---

extern const Class dofs_class, kinematics_class;

/// The number, from 0, of the DOF of a name.
/// throws  Error that tells the names
int dof_named(const std::string& name, const RobotHandle& robot, const What& what);
/// Names of DOFs in a table by names, sorted; empty: it is a list, or begins as one.
/// throws  Error for keys that are no names
std::vector<std::string> read_dof_names(lua_State* L, int i, const What& what);
/// A number for each DOF: a list of all, or a table by names; none for those that it leaves out.
std::vector<std::optional<double>> check_some_dofs(lua_State* L, int i, const RobotHandle& robot);
/// Values of all DOFs: the same, those that are left out as they are.
Eigen::VectorXd check_dofs(lua_State* L, int i, const RobotHandle& robot);
/// The same of a value that is no argument.
Eigen::VectorXd read_dofs(lua_State* L, int i, const What& what, const RobotHandle& robot);
/// Numbers, from 0, of DOFs in a list of numbers, from 1, and names.
std::vector<int> read_dof_numbers(lua_State* L, int i, const What& what, const RobotHandle& robot);

// --- eigengrasps: a hand's posture by a few amplitudes; of a hand, or of none yet. ---

/// A hand's own set as it is at any time, or a set by itself.
struct EigengraspsHandle {
  RobotHandle robot;  ///< without a world: none
  std::shared_ptr<const EigengraspSet> set;

  Eigengrasps ready() const { return robot.world ? Eigengrasps(*robot) : Eigengrasps(*set, {}); }
  /// the hand's own, which may be the identity, or the set
  EigengraspSet value() const;
};

extern const Class eigengrasps_class;

template <>
inline constexpr const Class* script_class<EigengraspsHandle> = &eigengrasps_class;

inline size_t owned_bytes(const EigengraspsHandle& handle) {
  if (!handle.set) return 0;  // the robot's
  const size_t numbers = static_cast<size_t>(handle.set->dofs) * (handle.set->grasps.size() + 2);
  return handle.set->grasps.size() * sizeof(EigengraspSpec) + numbers * sizeof(double);
}

/// Amplitudes of an argument.
/// throws  Error "hand:set_amplitudes: expected 2 amplitudes, got 3"
Eigen::VectorXd check_amplitudes(lua_State* L, int i, const Eigengrasps& grasps);

// --- virtual_contact: a place on a link where a hand would like to touch. ---

struct VirtualContactHandle {
  RobotHandle robot;
  VirtualContactSpec contact;
};

extern const Class virtual_contact_class;

template <>
inline constexpr const Class* script_class<VirtualContactHandle> = &virtual_contact_class;

inline size_t owned_bytes(const VirtualContactHandle& handle) {
  return static_cast<size_t>(handle.contact.edges.size()) * sizeof(double);
}

/// A list of virtual contacts.
int push_virtual_contacts(lua_State* L, const RobotHandle& robot,
                          const std::vector<VirtualContactSpec>& contacts);

/// The virtual contact that a value stands for: one of any hand's, a contact of the robot, or a
/// table {link = body | name | number, chain = number, frame = pose | point = , normal = , mu = ,
/// edges = }.
/// throws  Error that names what is wrong
VirtualContactSpec read_virtual_contact(lua_State* L, int i, const What& what,
                                        const RobotHandle& robot);

// --- wrench_space: which wrenches contacts resist. ---

/// `edges`: an integer or "exact"; empty when absent.
/// throws  Error "...: edges must be 3 to 1000 or 'exact', got 2"
std::optional<int> read_edges(Table& options);
/// Is `rho` the word "gyration"?   throws  Error when it is another word
bool is_gyration(Table& options);
/// `norm` and `coordinates`
WrenchSpaceOptions read_space_options(Table& options);

/// a list of names of coordinates; empty when absent
std::optional<std::vector<int>> read_coordinates(Table& options, const char* key);
std::vector<const char*> names_of(std::span<const int> coordinates);
inline constexpr Word<WrenchNorm> norm_words[] = {{"L1", WrenchNorm::l1},
                                                  {"Linf", WrenchNorm::linf}};
const char* norm_name(const WrenchSpace& s);

extern const Class wrench_space_class;

template <>
inline constexpr const Class* script_class<WrenchSpacePtr> = &wrench_space_class;

/// with what it works out when it is asked
size_t owned_bytes(const WrenchSpacePtr& space);

// --- projection: a wrench space in three coordinates. ---

struct ProjectionHandle {
  std::shared_ptr<const Projection> projection;
  ShapePtr shape;  ///< null when it is flat
  WrenchSpacePtr space;
};

/// of a wrench space: leaves its projection on the stack
int project_space(lua_State* L);

extern const Class projection_class;

template <>
inline constexpr const Class* script_class<ProjectionHandle> = &projection_class;

inline size_t owned_bytes(const ProjectionHandle& handle) {
  // its mesh lies in both
  return sizeof(Projection) + (handle.shape ? 2 * handle.shape->bytes() : 0);
}

// --- grasp. ---

/// A grasp, in its world or, of a planner or a file, in none.
struct GraspHandle {
  WorldPtr world;  ///< may be null
  Grasp grasp;
};

/// without the spaces, which are asked for later
inline size_t owned_bytes(const GraspHandle& handle) {
  return handle.grasp.contacts.size() * sizeof(Contact) +
         handle.grasp.points.size() * sizeof(PointContact);
}

/// The world whose method is called.
inline World& world_of(lua_State* L) { return *self<WorldHandle>(L).world; }

/// The world that the grasp stands in.   throws Error when it stands in none
const World& world_of(lua_State* L, const GraspHandle& grasp);

/// A number > 0, or a list of one per contact, whose values whoever takes them checks; none when
/// absent.
PerContact read_per_contact(Table& options, const char* key);

extern const Class grasp_class;

template <>
inline constexpr const Class* script_class<GraspHandle> = &grasp_class;

// --- grasps: lists of them, from files and to files. ---

struct GraspList {
  std::vector<GraspHandle> grasps;
};

extern const Class grasps_class;

template <>
inline constexpr const Class* script_class<GraspList> = &grasps_class;

// --- What every grasp can say of forces: the methods of grasp that balance loads. ---

extern const Class forces_class;

// --- What every grasp can say of its worth: the methods of grasp that measure it. ---

extern const Class measures_class;

// --- picture: what clench.render gives. ---

/// Reads size, samples and the camera, which must be all that is left of the options, and draws.
Picture draw_scene(lua_State* L, Table& options, Scene scene);

/// Logs why pictures have no letters, if they have none: once a Lua state.
void warn_without_letters(lua_State* L, const Font& font);

extern const Class picture_class;

template <>
inline constexpr const Class* script_class<Picture> = &picture_class;

inline size_t owned_bytes(const Picture& picture) {
  return picture.pixels.capacity() + picture.alpha.capacity();
}

// --- plot: numbers over numbers as a figure. ---

struct PlotHandle {
  std::shared_ptr<const Drawing> drawing;
};

extern const Class plot_class;

template <>
inline constexpr const Class* script_class<PlotHandle> = &plot_class;

inline size_t owned_bytes(const PlotHandle& handle) {
  return handle.drawing->items.size() * (sizeof(Drawing::Item) + 4 * sizeof(Eigen::Vector2f));
}

// --- cameras of worlds. ---

/// The pose of a camera at eye that sees target: along its -z, with y up.
/// throws Error begun by the subject when eye and target are one, or up is along the view
Pose camera_pose(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                 const Eigen::Vector3d& up, const std::string& subject);
int get_camera(lua_State* L);
int set_camera(lua_State* L);

}  // namespace clench
