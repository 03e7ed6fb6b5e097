// grasp.
#pragma once
#include <utility>
#include <vector>

#include "grasp/grasp.h"
#include "script/bind_wrench_space.h"
#include "script/handles.h"

namespace clench {

/// A grasp as it was measured, and its wrench spaces that somebody has asked for.
struct GraspHandle {
  WorldPtr world;
  Grasp grasp;
  std::vector<std::pair<GraspSpaceOptions, WrenchSpacePtr>> spaces;
};

/// without the spaces, which are asked for later
inline size_t owned_bytes(const GraspHandle& handle) {
  return handle.grasp.contacts.size() * (sizeof(Contact) + sizeof(PointContact));
}

/// A number > 0, or a list of one per contact, whose values whoever takes them checks; none when absent.
PerContact read_per_contact(Table& options, const char* key);

/// Made at the first call, and kept: the last max_kept_spaces of them.
const WrenchSpacePtr& space_of(GraspHandle& handle, const GraspSpaceOptions& options = {});

extern const Class grasp_class;
extern const Library grasp_library;

template <>
inline const Class& class_of<GraspHandle>() {
  return grasp_class;
}

}  // namespace clench
