// Size limit of wrench spaces, whose queries visit every edge.
#pragma once
#include <Eigen/Core>

namespace clench {

/// Largest number of edges, of all contacts together.
inline constexpr Eigen::Index max_space_edges = 100'000;

}  // namespace clench
