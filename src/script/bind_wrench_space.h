// wrench_space and its projections.
#pragma once
#include <memory>
#include <optional>

#include "grasp/projection.h"
#include "grasp/wrench_space.h"
#include "script/bind_mesh.h"
#include "script/table.h"

namespace clench {

using WrenchSpacePtr = std::shared_ptr<const WrenchSpace>;

struct ProjectionHandle {
  std::shared_ptr<const Projection> projection;
  ShapePtr shape;  ///< null when it is flat
  WrenchSpacePtr space;
};

/// `edges`: an integer or "exact"; empty when absent.
/// throws  Error "...: edges must be 3 to 1000 or 'exact', got 2"
std::optional<int> read_edges(Table& options);
/// Is `rho` the word "gyration"?   throws  Error when it is another word
bool is_gyration(Table& options);
/// `norm` and `coordinates`
WrenchSpaceOptions read_space_options(Table& options);

extern const Class wrench_space_class, projection_class;
extern const Library wrench_space_library;

template <>
inline const Class& class_of<WrenchSpacePtr>() {
  return wrench_space_class;
}
template <>
inline const Class& class_of<ProjectionHandle>() {
  return projection_class;
}

}  // namespace clench
