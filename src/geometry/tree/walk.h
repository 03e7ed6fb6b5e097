// Traversals of trees, eight boxes at a time: they find the candidate triangles for exact tests in
// double precision, and discard all others. For the queries of this module only. Includes no Eigen:
// the traversals may be compiled for the host's instruction set, and find the same triangles on
// every machine.
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
  double rounding;     ///< error of the exact coordinates: added to the slack of every bound [m]
};

/// Bound within which two things are near.
struct Reach {
  double distance;  ///< [m]
  /// from a to b near their nearest points, in the frame of a; any length; 0: unknown
  double along[3] = {0, 0, 0};
};

/// called with triangles; ends the traversal by returning true
using PairVisit = FunctionRef<bool(int triangle_a, int triangle_b)>;
using TriangleVisit = FunctionRef<bool(int triangle)>;

struct NearPair {
  int triangle_a, triangle_b;
};

/// Result of a test for the separation of two meshes.
struct Separation {
  bool found = false;  ///< certain: along the direction, b lies farther than the reach beyond a
  double along[3] = {0, 0, 0};  ///< in the frame of a; unit, up to 2^-14
};

/// Searches, for a few steps, for a direction along which b lies farther than reach, >= 0 [m],
/// beyond a.
/// start  tried first, unit; anything else is ignored
Separation find_separation(const TreePair& pair, double reach, const double start[3]);

/// Finds all pairs of triangles that may be within the reach.
void find_pairs_within(const TreePair& pair, double reach, std::vector<NearPair>& out);

/// Finds all pairs of triangles within the reach that may be the nearest. Those that may intersect
/// are passed to `meet` during the traversal, which ends if that returns true.
bool find_nearest_pairs(const TreePair& pair, const Reach& reach, std::vector<NearPair>& out,
                        PairVisit meet);

/// A lower bound of a distance [m], 0 if triangles intersect, and the nearest pair found; -1: none.
struct DistanceBound {
  double lower = 0;
  NearPair pair{-1, -1};
};

/// A lower bound that is at least the reach or `part` of the distance, whichever is less. The
/// distance of the surfaces is known to be at most `nearest`.
DistanceBound bound_distance(const TreePair& pair, const Reach& reach, double part, double nearest,
                             PairVisit meet);

/// Visits all pairs of triangles that may intersect, likely ones early.
bool for_meeting_pairs(const TreePair& pair, PairVisit visit);

/// Visits all triangles that may be within reach [m] of p (about the tree's center); of these, if
/// nearest_only, all that may be the nearest. The result of visit is ignored.
void for_near_triangles(const Tree& tree, const double p[3], double rounding, double reach,
                        bool nearest_only, TriangleVisit visit);

/// Visits all triangles that a ray may hit within `limit` [m], near ones early.
/// direction  unit
bool for_crossed_triangles(const Tree& tree, const double origin[3], const double direction[3],
                           double rounding, const double& limit, TriangleVisit visit);

}  // namespace clench
