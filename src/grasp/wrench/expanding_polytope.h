// Polytopes that grow inside a convex set until they tell what is asked of it: the largest ball
// about the origin, or all facets. The set is known by its support function only. Includes no
// Eigen.
//
// The polytope starts as a simplex of points of the set. Its facet nearest to the origin asks how
// far the set reaches along its normal: not beyond the facet means that the facet is one of the
// set, and as the set contains the polytope, no other is nearer. Else the polytope expands to the
// point found: the facets that see it go, and the rim that they leave is joined to it.
//
// At every moment the nearest facet is a lower bound of the ball's radius and the least support
// found an upper one. The lower bound needs no more than that the facets are closed around the
// origin, which follows from how they are joined, and that each plane holds its points, which is
// checked for the plane that decides; a wrong turn of rounding elsewhere costs time, not truth.
// source  van den Bergen (2001), Proximity queries and penetration depth computation, in 3
//         dimensions
#pragma once
#include <vector>

#include "clench/base/progress.h"
#include "clench/grasp/wrench/support_set.h"

namespace clench {

// Lengths are absolute: sets of size about one are meant.
struct BallOptions {
  double tolerance = 1e-12;  ///< upper - lower that is enough, >= 1e-12
  /// a set that reaches no farther in some direction leaves the origin outside
  double zero = 1e-12;
  double at_least = 0;         ///< > 0: enough to know whether the radius is below this
  int max_points = 100000;     ///< of the polytope
  int max_facets = 2'000'000;  ///< at once
  Progress progress = {};      ///< a stop ends it as max_points does
};

enum class BallEnd {
  inside,   ///< lower and upper are within the tolerance
  outside,  ///< the set reaches at most `zero` along the direction: no ball
  flat,     ///< the set lies in a hyperplane normal to the direction
  decided,  ///< at_least is below lower or above upper
  stopped   ///< the bracket holds, and is wider than asked: max_points or max_facets, or rounding
};

struct Ball {
  BallEnd end = BallEnd::stopped;
  double lower = 0;  ///< a ball of this radius about the origin lies inside the set
  double upper = 0;  ///< how far the set reaches along the direction
  double direction[max_dimensions] = {};  ///< unit, of the least support found
  int points = 0;                         ///< of the polytope at the end
};

/// set  of 2 to max_dimensions dimensions
Ball largest_ball(const SupportSet& set, const BallOptions& options = {});

enum class FacetsEnd { complete, flat, too_many, failed };

/// The polytope that has grown to the whole set.
struct Facets {
  FacetsEnd end = FacetsEnd::failed;
  std::vector<double> points;  ///< dimension numbers a point
  /// dimension indices of points a facet, all facets turned the same way
  std::vector<int> corners;
  double volume = 0;
};

struct FacetsOptions {
  double tolerance = 1e-12;    ///< how far the set may reach beyond a facet
  int max_facets = 2'000'000;  ///< then it ends with too_many
  Progress progress = {};
};

/// Facets are simplices; one with more corners comes as several. `failed`: rounding broke the
/// surface even after all points were shifted a little.   throws Stopped
Facets all_facets(const SupportSet& set, const FacetsOptions& options = {});

}  // namespace clench
