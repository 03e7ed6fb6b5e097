// patch: the surfaces of two bodies around a soft contact, and the turn that it resists.
#pragma once
#include "contact/soft_patch.h"
#include "model/find.h"
#include "script/handles.h"
#include "script/table.h"

namespace clench {

struct PatchHandle {
  std::shared_ptr<const SoftPatch> patch;
  Pose X_WA;
  bool body_is_b = false;  ///< of the contact that was asked: its body is the patch's b
  double mu = 0;
};

extern const Class patch_class;

template <>
inline const Class& class_of<PatchHandle>() {
  return patch_class;
}

inline size_t owned_bytes(const PatchHandle& handle) {
  const auto& points = handle.patch->points;
  return sizeof(SoftPatch) + (points[0].size() + points[1].size()) * sizeof(Eigen::Vector3d);
}

/// "series" or "larger" of an option `modulus`
ModulusRule read_modulus_rule(Table& options);
/// as that takes it
const char* modulus_name(ModulusRule rule);

}  // namespace clench
