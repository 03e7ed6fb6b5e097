// Contacts, and the patches of soft ones.
#pragma once
#include <memory>
#include <vector>

#include "clench/contact/soft_patch.h"
#include "clench/model/find.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

// --- patch: the surfaces of two bodies around a soft contact, and the torsional friction that it
// transmits. ---

struct PatchHandle {
  std::shared_ptr<const SoftPatch> patch;
  Pose X_WA;
  bool body_is_b = false;  ///< of the contact that created it: its body is the patch's b
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
/// the name of a rule, as in that option
const char* modulus_name(ModulusRule rule);

// --- contact: a point where one body touches another, as it was when queried. ---

struct ContactHandle {
  WorldPtr world;
  Contact contact;
  std::shared_ptr<const SoftPatch> patch = nullptr;  ///< after the first request
};

extern const Class contact_class;

template <>
inline constexpr const Class* script_class<ContactHandle> = &contact_class;

/// A list of contacts.
int push_contacts(lua_State* L, const WorldPtr& world, const std::vector<Contact>& contacts);

}  // namespace clench
