// Polytopes that expand inside a convex set until they determine the largest ball about the origin,
// or all facets. The set is given by its support function only. Includes no Eigen.
//
// The polytope starts as a simplex of points of the set. The support of the set along the normal of
// the facet nearest to the origin is computed: if it does not exceed the facet, the facet is one of
// the set, and as the set contains the polytope, no other is nearer. Otherwise the polytope expands
// to the support point: the facets visible from it are removed, and the rim of the hole is joined
// to it.
//
// At any time the distance of the nearest facet is a lower bound of the ball's radius, and the
// smallest support found is an upper one. The lower bound requires only that the facets are closed
// around the origin, which follows from their adjacency, and that each plane contains its points,
// which is checked for the plane that decides; rounding errors elsewhere cost time, but do not
// invalidate the bounds.
// source  van den Bergen (2001), Proximity queries and penetration depth computation, in 3
//         dimensions
#pragma once
#include <vector>

#include "clench/base/progress.h"
#include "clench/grasp/wrench/support_set.h"

namespace clench {

// Lengths are absolute: sets of size about one are expected.
struct BallOptions {
  double tolerance = 1e-12;  ///< sufficient difference upper - lower, >= 1e-12
  /// a set whose support is at most this in some direction does not contain the origin
  double zero = 1e-12;
  double at_least = 0;         ///< > 0: stop once it is known whether the radius is below this
  int max_points = 100000;     ///< of the polytope
  int max_facets = 2'000'000;  ///< at one time
  Progress progress = {};      ///< a stop request ends the search as max_points does
};

enum class BallEnd {
  inside,   ///< lower and upper are within the tolerance
  outside,  ///< the support along the direction is at most `zero`: no ball
  flat,     ///< the set lies in a hyperplane normal to the direction
  decided,  ///< at_least is below lower or above upper
  /// the bracket is valid, but wider than requested: max_points or max_facets, or rounding
  stopped
};

struct Ball {
  BallEnd end = BallEnd::stopped;
  double lower = 0;  ///< a ball of this radius about the origin lies inside the set
  double upper = 0;  ///< support of the set along the direction
  double direction[max_dimensions] = {};  ///< unit, direction of the smallest support found
  int points = 0;                         ///< of the polytope at the end
};

/// set  of 2 to max_dimensions dimensions
Ball largest_ball(const SupportSet& set, const BallOptions& options = {});

enum class FacetsEnd { complete, flat, too_many, failed };

/// The polytope expanded to the complete set.
struct Facets {
  FacetsEnd end = FacetsEnd::failed;
  std::vector<double> points;  ///< `dimension` numbers per point
  /// `dimension` indices of points per facet, all facets with the same orientation
  std::vector<int> corners;
  double volume = 0;
};

struct FacetsOptions {
  double tolerance = 1e-12;    ///< largest extent of the set beyond a facet
  int max_facets = 2'000'000;  ///< limit, beyond which the result is too_many
  Progress progress = {};
};

/// Facets are simplices; a facet with more corners is returned as several. `failed`: rounding broke
/// the surface even after all points were shifted slightly.
/// throws Stopped
Facets all_facets(const SupportSet& set, const FacetsOptions& options = {});

}  // namespace clench
