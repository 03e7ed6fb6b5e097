// wrench_space: which wrenches contacts resist.
#pragma once
#include <memory>
#include <optional>
#include <span>

#include "grasp/kept_spaces.h"
#include "script/bind_mesh.h"
#include "script/table.h"

namespace clench {

/// `edges`: an integer or "exact"; empty when absent.
/// throws  Error "...: edges must be 3 to 1000 or 'exact', got 2"
std::optional<int> read_edges(Table& options);
/// Is `rho` the word "gyration"?   throws  Error when it is another word
bool is_gyration(Table& options);
/// `norm` and `coordinates`
WrenchSpaceOptions read_space_options(Table& options);

/// a list of names of coordinates; empty when absent
std::optional<std::vector<int>> read_coordinates(Table& options, const char* key);
int push_coordinate_names(lua_State* L, std::span<const int> coordinates);
const char* norm_name(const WrenchSpace& s);

extern const Class wrench_space_class;
extern const Library wrench_space_library;

template <>
inline const Class& class_of<WrenchSpacePtr>() {
  return wrench_space_class;
}

/// with what it works out when it is asked
size_t owned_bytes(const WrenchSpacePtr& space);

}  // namespace clench
