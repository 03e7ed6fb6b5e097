// qhull as a reference, with selectable options.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

namespace clench::bench {

struct QhullAnswer {
  /// smallest distance of facets from the origin; above 0 if the origin is inside
  double min_offset = 0;
  double volume = 0;  ///< computed with option FA
};

/// points   one per column
/// options  "qhull Qx"
/// returns  empty if qhull reports an error
std::optional<QhullAnswer> ask_qhull(const Eigen::MatrixXd& points, const std::string& options);

}  // namespace clench::bench
