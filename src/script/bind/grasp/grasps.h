// Grasps, lists of them, and their measures.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "clench/grasp/wrench/grasp.h"
#include "clench/script/bind/grasp/wrench_spaces.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"

namespace clench {

extern const Library grasp_library, grasps_library, measures_library;

// --- grasp. ---

/// A grasp, in its world or, if from a planner or a file, in none.
struct GraspHandle {
  WorldPtr world;  ///< may be null
  Grasp grasp;
};

/// without wrench spaces, which are computed on demand
inline size_t owned_bytes(const GraspHandle& handle) {
  return handle.grasp.contacts.size() * sizeof(Contact) +
         handle.grasp.points.size() * sizeof(PointContact);
}

/// The world of the grasp.
/// throws  Error if it belongs to none
const World& world_of(lua_State* L, const GraspHandle& grasp);

/// A number > 0, or a list of one per contact, whose values are checked by the caller; empty if
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

// --- Methods of every grasp that balance loads. ---

extern const Class forces_class;

// --- Methods of every grasp that measure it. ---

extern const Class measures_class;

}  // namespace clench
