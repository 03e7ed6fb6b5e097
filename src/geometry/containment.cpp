#include "geometry/containment.h"

#include <algorithm>
#include <utility>

#include "geometry/queries.h"

namespace clench {

// A corner, in the frame of `outer`, of the first part of `inner` that lies in the solid of `outer`.
// A part whose extremes are not all within the bounds does not.
template <class ToOuter>
static std::optional<std::pair<Eigen::Vector3d, int>> held_part(const Shape& inner,
                                                                const Shape& outer,
                                                                ToOuter to_outer) {
  if (!outer.closed()) return {};
  const auto& extremes = inner.part_extremes();
  const auto outside = [&](const Eigen::Vector3d& p) { return !outer.bounds().holds(to_outer(p)); };
  for (size_t i = 0; i < inner.parts().size(); ++i) {
    if (!extremes.empty() && std::any_of(extremes[i].begin(), extremes[i].end(), outside)) continue;
    const int part = inner.parts()[i];
    const Eigen::Vector3d p = to_outer(inner.mesh().corners(part)[0]);
    if (contains(outer, p)) return std::pair(p, part);
  }
  return {};
}

std::optional<Containment> find_containment(const Shape& a, const Shape& b,
                                            const Placement& placement) {
  const auto to_a = [&](const Eigen::Vector3d& p) { return placement.to_a(p); };
  const auto to_b = [&](const Eigen::Vector3d& p) { return placement.to_b(p); };
  if (const auto held = held_part(b, a, to_a)) return Containment{held->first, -1, held->second};
  if (const auto held = held_part(a, b, to_b))
    return Containment{a.mesh().corners(held->second)[0], held->second, -1};
  return {};
}

}  // namespace clench
