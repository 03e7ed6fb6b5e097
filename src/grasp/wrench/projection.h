// Wrench spaces in three dimensions, to be looked at.
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
      {};                           ///< coordinates at a value: a section of the space
  std::vector<int> projected = {};  ///< coordinates that may be anything: its projection
  /// how far the space may reach beyond the mesh, as a part of its size, when a contact has a round
  /// cone
  double tolerance = 1e-3;
  Progress progress = {};
};

struct Projection {
  std::array<int, 3> free;  ///< the coordinates that are left, in the space's order
  std::vector<std::pair<int, double>> fixed;
  std::vector<int> projected;
  double volume = 0;  ///< 0 when it is flat
  Mesh mesh;          ///< its surface, x y z the free coordinates; empty when it is flat
};

/// throws  Error when three free coordinates are not left, one is named twice or does not count in
///         the space, a number is not finite, the tolerance is not > 0, or nothing has the fixed
///         values; Stopped
Projection project(const WrenchSpace& space, const ProjectionOptions& options = {});

}  // namespace clench
