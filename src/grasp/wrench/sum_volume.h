// Volume of a Minkowski sum of convex hulls.
#pragma once
#include <Eigen/Core>
#include <span>

#include "clench/base/progress.h"

namespace clench {

struct SumVolume {
  enum End {
    complete,
    too_many,  ///< more cells than requested
    failed     ///< rounding broke the cells for all liftings
  };
  End end = failed;
  double volume = 0;
  int cells = 0;  ///< of which the sum consists
};

/// Volume of {x1 + x2 + ...}, each from the hull of the columns of one summand; they have 1 to 6
/// rows and size about one. Columns closer than 1e-9 count as one. Time is proportional to the
/// number of cells, a few times that of the facets formed by the summands' faces.
///
/// The sum is divided into cells that are sums of simplices, one of each summand, by lifting each
/// point to a random height: cells are the facets visible from above. From one cell the others are
/// reached across walls. All volumes are positive, so nothing cancels, however degenerate the sum
/// is; cells that disagree about a common wall reveal rounding errors.
///
/// returns  0 if the sum is flat
/// throws   Stopped
/// source   Huber & Sturmfels (1995), A polyhedral method for solving sparse polynomial systems
SumVolume sum_volume(std::span<const Eigen::MatrixXd> summands, int max_cells,
                     const Progress& progress = {});

}  // namespace clench
