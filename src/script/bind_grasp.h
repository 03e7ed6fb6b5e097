// grasp.
#pragma once
#include "grasp/grasp.h"
#include "script/bind_wrench_space.h"
#include "script/handles.h"

namespace clench {

/// A grasp, in its world or, read from a file, in none.
struct GraspHandle {
  WorldPtr world;  ///< may be null
  Grasp grasp;
};

/// without the spaces, which are asked for later
inline size_t owned_bytes(const GraspHandle& handle) {
  return handle.grasp.contacts.size() * sizeof(Contact) +
         handle.grasp.points.size() * sizeof(PointContact);
}

/// The world that the grasp stands in.   throws Error when it was read from a file
const World& world_of(lua_State* L, const GraspHandle& grasp);

/// A number > 0, or a list of one per contact, whose values whoever takes them checks; none when absent.
PerContact read_per_contact(Table& options, const char* key);

extern const Class grasp_class;
extern const Library grasp_library;

template <>
inline const Class& class_of<GraspHandle>() {
  return grasp_class;
}

}  // namespace clench
