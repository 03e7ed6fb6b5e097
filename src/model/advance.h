// Conservative advancement of many pairs along one motion: finds the first touch.
// source  Mirtich (1996), ch. 2: a pair at distance d cannot collide within d / (bound of its
//         speed)
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "clench/model/find.h"

namespace clench {

/// A pair to be checked while a parameter s runs from 0 to the end of a motion.
struct PairBound {
  Id<Body> a, b;
  /// upper bound on the relative speed of any two of their points [m per unit of s]
  double speed = 0;
  /// lower bound on their distance at the start of the motion; 0: unknown [m]
  double clear = 0;

  bool touching = false;  ///< within the threshold since the start: it may slide and separate
  /// last measurement: the distance, or beyond many thresholds, a lower bound [m]
  double gap = 0;
  std::array<int, 2> near = {-1, -1};  ///< triangles of the pair that were nearly the nearest last
  double safe = 0;                     ///< farther apart than the aimed gap before this s
};

struct Advance {
  double s = 0;                         ///< present value of s
  std::optional<PairBound> stopped_by;  ///< the pair that ended it
  bool iteration_limit = false;         ///< it ended because of the limit on steps, not by a touch
};

/// A smaller gap, as a fraction of the threshold, results from pressing, not from sliding.
inline constexpr double nearly_closed = 1.0 / 64;

/// Runs s from 0 to `end`, measuring each pair only when its guarantee of separation ends, and
/// stops at the first that comes within the threshold: well within it, or where a pair that passes
/// by is nearest. `place(s)` must put the bodies where they are at s; on return it has been called
/// with the final s. The gap at a stop is in (0, threshold]. A pair that touches at the start stops
/// the motion only when its gap nearly closes.
/// watches  with a, b, speed and perhaps clear given; nothing collides at s = 0. On return `clear`
///          holds at s, the next start
/// queries  counts the distance queries made
/// max_steps  a motion that needs more grazes over meters within micrometers: it stops where it is
/// throws   Error if the bodies are so far out that rounding hides the threshold
Advance advance(World& world, std::vector<PairBound>& watches, double end,
                const std::function<void(double)>& place, int& queries, int max_steps = 1000000);

}  // namespace clench
