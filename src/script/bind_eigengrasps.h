// eigengrasps: a hand's posture by a few amplitudes; of a hand, or of none yet.
#pragma once
#include "motion/eigengrasps.h"
#include "script/handles.h"

namespace clench {

/// A hand's own set as it is at any time, or a set by itself.
struct EigengraspsHandle {
  RobotHandle robot;  ///< without a world: none
  std::shared_ptr<const EigengraspSet> set;

  Eigengrasps ready() const { return robot.world ? Eigengrasps(*robot) : Eigengrasps(*set, {}); }
  /// the hand's own, which may be the identity, or the set
  EigengraspSet value() const;
};

extern const Class eigengrasps_class;
extern const Library eigengrasps_library;

template <>
inline const Class& class_of<EigengraspsHandle>() {
  return eigengrasps_class;
}

inline size_t owned_bytes(const EigengraspsHandle& handle) {
  if (!handle.set) return 0;  // the robot's
  const size_t numbers = static_cast<size_t>(handle.set->dofs) * (handle.set->grasps.size() + 2);
  return handle.set->grasps.size() * sizeof(EigengraspSpec) + numbers * sizeof(double);
}

/// Amplitudes of an argument.
/// throws  Error "hand:set_amplitudes: expected 2 amplitudes, got 3"
Eigen::VectorXd check_amplitudes(lua_State* L, int i, const Eigengrasps& grasps);

}  // namespace clench
