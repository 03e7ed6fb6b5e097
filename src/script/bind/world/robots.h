// Declarations shared by the bindings of bodies and robots: motions, DOFs, eigengrasps, virtual
// contacts.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clench/motion/drive.h"
#include "clench/motion/eigengrasps.h"
#include "clench/motion/move.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/values.h"

namespace clench {

extern const Library eigengrasps_library;

// --- Fields common to bodies and robots: material, mass, surface, color; a robot has those of its
// base. ---

extern const Class entity_class;

// --- body: an object, an obstacle or a part of a robot. ---

/// Result of a move: {fraction, touched, stopped_by, queries}.
int push_move(lua_State* L, const WorldPtr& world, const MoveResult& result);

// --- hand: parts of a robot used for grasping: eigengrasps, virtual contacts, a glove, sensors,
// tendons. ---

/// fields and methods of every robot
extern const Class hand_class;

/// {slopes, intercepts}
int push(lua_State* L, const GloveCalibration& glove);

/// Result of a drive: {moved, stops, stopped_by, queries, events}.
int push_drive(lua_State* L, const WorldPtr& world, const DriveResult& result);

// --- Methods of every robot for its DOFs and the poses of its links. ---

extern const Class dofs_class, kinematics_class;

/// The index, from 0, of the DOF with a name.
/// throws  Error that lists the names
int dof_named(const std::string& name, const RobotHandle& robot, const What& what);
/// Sorted names of DOFs in a table indexed by names; empty if it is a list, or begins as one.
/// throws  Error for keys that are not names
std::vector<std::string> read_dof_names(lua_State* L, int i, const What& what);
/// A number for each DOF: a list of all, or a table indexed by names; empty for those left out.
std::vector<std::optional<double>> check_some_dofs(lua_State* L, int i, const RobotHandle& robot);
/// Values of all DOFs, in the same form; those left out keep their values.
Eigen::VectorXd check_dofs(lua_State* L, int i, const RobotHandle& robot);
/// The same for a value that is not an argument.
Eigen::VectorXd read_dofs(lua_State* L, int i, const What& what, const RobotHandle& robot);
/// Indices, from 0, of DOFs in a list of numbers, from 1, and names.
std::vector<int> read_dof_numbers(lua_State* L, int i, const What& what, const RobotHandle& robot);

// --- eigengrasps: a hand's posture by a few amplitudes; of a hand, or independent. ---

/// A view of a hand's current set, or an independent set.
struct EigengraspsHandle {
  RobotHandle robot;  ///< null if independent
  std::shared_ptr<const EigengraspSet> set;

  Eigengrasps ready() const { return robot.world ? Eigengrasps(*robot) : Eigengrasps(*set, {}); }
  /// the hand's own, which may be the identity, or the independent set
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

/// Amplitudes in an argument.
/// throws  Error "hand:set_amplitudes: expected 2 amplitudes, got 3"
Eigen::VectorXd check_amplitudes(lua_State* L, int i, const Eigengrasps& grasps);

// --- virtual_contact: a desired contact point on a link. ---

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

/// The virtual contact given by a value: one of any hand's, a contact of the robot, or a table
/// {link = body | name | number, chain = number, frame = pose | point = , normal = , mu = , edges =
/// }.
/// throws  Error that names the fault
VirtualContactSpec read_virtual_contact(lua_State* L, int i, const What& what,
                                        const RobotHandle& robot);

}  // namespace clench
