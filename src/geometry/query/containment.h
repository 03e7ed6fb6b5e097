// One solid inside another without intersecting surfaces. For the queries of this module only.
#pragma once
#include <optional>

#include "clench/geometry/query/placement.h"

namespace clench {

struct Containment {
  Eigen::Vector3d point;  ///< in both, in the frame of a
  /// triangle of the inner shape with that point as a corner; -1 for the outer shape
  int triangle_a = -1, triangle_b = -1;
};

/// Does a part of one shape lie in the solid of the other? Tests one corner of each connected part,
/// which is sufficient only if the surfaces do not intersect.
std::optional<Containment> find_containment(const Shape& a, const Shape& b,
                                            const Placement& placement);

}  // namespace clench
