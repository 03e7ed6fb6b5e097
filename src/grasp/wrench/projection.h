// Wrench spaces in three dimensions, for display.
#pragma once
#include <array>
#include <utility>
#include <vector>

#include "clench/geometry/mesh/mesh.h"
#include "clench/grasp/wrench/wrench_space.h"

namespace clench {

/// The names of a wrench's coordinates, from 0.
inline constexpr std::array<const char*, 6> coordinate_names = {"fx", "fy", "fz", "tx", "ty", "tz"};

struct ProjectionOptions {
  std::vector<std::pair<int, double>> fixed =
      {};                           ///< coordinates with prescribed values: a section of the space
  std::vector<int> projected = {};  ///< coordinates that are projected out
  /// largest extent of the space beyond the mesh, as a fraction of its size, if a contact has a
  /// round cone
  double tolerance = 1e-3;
  Progress progress = {};
};

struct Projection {
  std::array<int, 3> free;  ///< the remaining coordinates, in the space's order
  std::vector<std::pair<int, double>> fixed;
  std::vector<int> projected;
  double volume = 0;  ///< 0 if it is flat
  Mesh mesh;          ///< its surface, x y z the free coordinates; empty if it is flat
};

/// throws  Error unless three free coordinates remain, if one is named twice or not used in the
///         space, a number is not finite, the tolerance is not > 0, or no point has the fixed
///         values; Stopped
Projection project(const WrenchSpace& space, const ProjectionOptions& options = {});

}  // namespace clench
