// Wrench spaces and their projections.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clench/geometry/tree/shape.h"
#include "clench/grasp/wrench/kept_spaces.h"
#include "clench/grasp/wrench/projection.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"

namespace clench {

extern const Library wrench_space_library;

// --- wrench_space: wrenches that contacts resist. ---

/// `edges`: an integer or "exact"; empty when absent.
/// throws  Error "...: edges must be 3 to 1000 or 'exact', got 2"
std::optional<int> read_edges(Table& options);
/// Is `rho` the word "gyration"?
/// throws  Error if it is another word
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

/// including values computed on demand
size_t owned_bytes(const WrenchSpacePtr& space);

// --- projection: a wrench space in three coordinates. ---

struct ProjectionHandle {
  std::shared_ptr<const Projection> projection;
  ShapePtr shape;  ///< null if it is flat
  WrenchSpacePtr space;
};

/// of a wrench space: pushes its projection
int project_space(lua_State* L);

extern const Class projection_class;

template <>
inline constexpr const Class* script_class<ProjectionHandle> = &projection_class;

inline size_t owned_bytes(const ProjectionHandle& handle) {
  // its mesh is included in both
  return sizeof(Projection) + (handle.shape ? 2 * handle.shape->bytes() : 0);
}

}  // namespace clench
