// qhull as a peer, with options of one's choice.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

namespace clench::bench {

struct QhullAnswer {
  double min_offset = 0;  ///< of all facets from the origin; above 0: inside
  double volume = 0;      ///< with option FA
};

/// points   a column each
/// options  "qhull Qx"
/// returns  nothing when it refuses
std::optional<QhullAnswer> ask_qhull(const Eigen::MatrixXd& points, const std::string& options);

}  // namespace clench::bench
