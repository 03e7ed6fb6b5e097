// Volume of a sum of convex hulls.
#pragma once
#include <Eigen/Core>
#include <span>

#include "clench/base/progress.h"

namespace clench {

struct SumVolume {
  enum End {
    complete,
    too_many,  ///< more cells than asked for
    failed     ///< rounding broke the cells, however the points were lifted
  };
  End end = failed;
  double volume = 0;
  int cells = 0;  ///< that the sum was cut into
};

/// Of {x1 + x2 + ...}, each from the hull of the columns of one summand; they have 1 to 6 rows and
/// size about one. Columns closer than 1e-9 count as one. Time goes with the cells; they are a few
/// times as many as the facets that the summands' faces make.
///
/// The sum is cut into cells that are sums of simplices, one of each summand, by lifting each point
/// to a random height: cells are what is seen from above. From one cell the others are reached
/// across walls. All volumes are positive, so however degenerate the sum is, nothing
/// cancels; cells that do not see each other alike across a wall betray rounding.
///
/// returns  0 where the sum is flat
/// throws   Stopped
/// source   Huber & Sturmfels (1995), A polyhedral method for solving sparse polynomial systems
SumVolume sum_volume(std::span<const Eigen::MatrixXd> summands, int max_cells,
                     const Progress& progress = {});

}  // namespace clench
