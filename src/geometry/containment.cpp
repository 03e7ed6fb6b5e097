#include "geometry/containment.h"

#include "geometry/queries.h"

namespace clench {

std::optional<Containment> find_containment(const Shape& a, const Shape& b,
                                            const Placement& placement) {
  if (a.closed())
    for (const int part : b.parts()) {
      const Eigen::Vector3d p = placement.corners_b(part)[0];
      if (contains(a, p)) return Containment{p, -1, part};
    }
  if (b.closed())
    for (const int part : a.parts()) {
      const Eigen::Vector3d p = placement.corners_a(part)[0];
      if (contains(b, placement.to_b(p))) return Containment{p, part, -1};
    }
  return {};
}

}  // namespace clench
