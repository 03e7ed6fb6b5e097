#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/geometry/tree/bounding_polytope.h"
#include "clench/geometry/tree/precision.h"
#include "clench/geometry/tree/tree_pair.h"
#include "clench/geometry/tree/walk.h"

namespace clench {

namespace {

// Two polytopes, and the point of each that is nearest to the other along a direction n, from a to
// b. Rounding, as in box_lanes.h: for radii r, the mesh extends up to 16 u r beyond its
// bounding_polytope, the corner chosen is up to 11 u r short of the farthest, n in the frame of b
// has an error of 9 u r; a corner of b in the frame of a, and its difference along n, have an error
// of 14 u l. The query's slack of 64 u (l + r) covers it.
class PolytopePair {
 public:
  explicit PolytopePair(const TreePair& pair)
      : a_(pair.a->bounding_polytope()),
        b_(pair.b->bounding_polytope()),
        b_to_a_(move_of<float>(pair)) {}

  // from the farthest corner of a to the rearmost corner of b
  CLENCH_INLINE Triple<float> between(const Triple<float>& n) const {
    const auto& row = b_to_a_.row;
    const Triple<float> n_b = row[0].scaled(n.x) + row[1].scaled(n.y) + row[2].scaled(n.z);
    return b_to_a_(corner(b_, {-n_b.x, -n_b.y, -n_b.z})) - corner(a_, n);
  }
  const Triple<float>& offset() const { return b_to_a_.offset; }

 private:
  static CLENCH_INLINE Triple<float> corner(const BoundingPolytope& bounding_polytope,
                                            const Triple<float>& n) {
    return farthest_point<FloatLanes>(bounding_polytope.corners, bounding_polytope.bundles, n).at;
  }

  const BoundingPolytope &a_, &b_;
  const Move<float> b_to_a_;
};

}  // namespace

// If a direction fails to separate, it is reflected at the violating support vector, while that
// reduces the overlap.
// source  Chung & Wang (1996), Quick collision detection of polytopes in virtual environments
Separation find_separation(const TreePair& pair, double reach, const double start[3]) {
  // after this many reflections, a direction is still unit up to 2^-14
  constexpr int max_mirrors = 12;
  Separation out;
  const double extent = extent_of(pair), sizes = pair.a->radius() + pair.b->radius();
  if (!single_is_enough(extent, sizes)) return out;
  const float limit =
      (at_least<float>(reach) + slack_of<float>(extent, sizes, pair.rounding)) * (1 + 0x1p-13f);
  const PolytopePair polytopes(pair);
  const auto single = [](double x) { return static_cast<float>(x); };
  Triple<float> n = {single(start[0]), single(start[1]), single(start[2])};
  float length = std::sqrt(dot(n, n));
  if (!(length > 0.5f && length < 2)) {
    n = polytopes.offset();
    length = std::sqrt(dot(n, n));
    if (!(length > 0)) return out;
  }
  n = n.scaled(1 / length);
  float best = std::numeric_limits<float>::lowest();
  for (int i = 0; i <= max_mirrors; ++i) {
    const Triple<float> between = polytopes.between(n);
    const float gap = dot(between, n), squared = dot(between, between);
    out = {gap > limit, {n.x, n.y, n.z}};
    if (out.found || !(gap > best) || !(squared > 0)) break;
    best = gap;
    n = n - between.scaled(2 * gap / squared);
  }
  return out;
}

}  // namespace clench
