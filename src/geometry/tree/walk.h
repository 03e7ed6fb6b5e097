// Walks over trees, eight boxes at a time: they name the triangles that an exact test in double
// must judge, and let the others go. For the queries of this module only. Includes no Eigen: the
// walks may be compiled for the machine at hand, and name the same triangles on every machine.
#pragma once
#include <limits>
#include <vector>

#include "clench/base/function_ref.h"
#include "clench/geometry/tree/tree.h"

namespace clench {

/// Two trees, each about its own center: p_a = rotation p_b + offset.
struct TreePair {
  const Tree *a, *b;
  double rotation[9];  ///< by rows
  double offset[3];    ///< [m]
  double rounding;     ///< of the exact coordinates: added to the slack of every bound [m]
};

/// How near two things must be to matter.
struct Reach {
  double distance;  ///< [m]
  /// from a to b where they are near, in the frame of a; any length; 0 when unknown
  double along[3] = {0, 0, 0};
};

/// of triangles; ends the walk by returning true
using PairVisit = FunctionRef<bool(int triangle_a, int triangle_b)>;
using TriangleVisit = FunctionRef<bool(int triangle)>;

struct NearPair {
  int triangle_a, triangle_b;
};

/// Result of a test for the separation of two meshes.
struct Separation {
  bool found = false;  ///< sure: b lies farther than the reach beyond a along the direction
  double along[3] = {0, 0, 0};  ///< in the frame of a; unit, up to 2^-14
};

/// Looks for a direction along which b lies farther than reach, >= 0 [m], beyond a. Gives up soon.
/// start  tried first, unit; anything else is ignored
Separation find_separation(const TreePair& pair, double reach, const double start[3]);

/// Finds all pairs of triangles that may be as near as the reach.
void find_pairs_within(const TreePair& pair, double reach, std::vector<NearPair>& out);

/// Finds all pairs of triangles within the reach that may be the nearest. Those that may meet are
/// shown to `meet` on the way, which ends the walk by returning true.
bool find_nearest_pairs(const TreePair& pair, const Reach& reach, std::vector<NearPair>& out,
                        PairVisit meet);

/// A lower bound of a distance [m], 0 where triangles meet, and the pair that is nearest as far as
/// was looked; -1: none.
struct DistanceBound {
  double lower = 0;
  NearPair pair{-1, -1};
};

/// At least the reach, or `part` of the distance where that is less. Surfaces are known to be as
/// near as `nearest`.
DistanceBound bound_distance(const TreePair& pair, const Reach& reach, double part, double nearest,
                             PairVisit meet);

/// Visits all pairs of triangles that may meet, likely ones early.
bool for_meeting_pairs(const TreePair& pair, PairVisit visit);

/// Visits all triangles that may be as near to p (about the tree's center) as reach [m]; of these,
/// if nearest_only, all that may be the nearest. What visit returns ends nothing.
void for_near_triangles(const Tree& tree, const double p[3], double rounding, double reach,
                        bool nearest_only, TriangleVisit visit);

/// Visits all triangles that a ray may meet within `limit` [m], near ones early.
/// direction  unit
bool for_crossed_triangles(const Tree& tree, const double origin[3], const double direction[3],
                           double rounding, const double& limit, TriangleVisit visit);

}  // namespace clench
