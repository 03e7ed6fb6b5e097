// The largest wrench space, as what asks about one goes through all of its edges.
#pragma once
#include <Eigen/Core>

namespace clench {

/// Edges of all contacts together.
inline constexpr Eigen::Index max_space_edges = 100'000;

}  // namespace clench
