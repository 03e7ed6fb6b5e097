// Conservative advancement of many pairs along one motion: how far can it go before the first
// touch?
// source  Mirtich (1996), ch. 2: a pair at distance d cannot meet within d / (bound of its speed)
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "clench/model/find.h"

namespace clench {

/// A pair under watch while a parameter s runs from 0 to the end of a motion.
struct PairBound {
  Id<Body> a, b;
  double speed = 0;  ///< bound of the relative speed of any two of their points [m per unit of s]
  /// known to be at least this far apart where the motion starts; 0: unknown [m]
  double clear = 0;

  bool touching = false;  ///< within the threshold since the start: it may slide and leave
  /// as last measured: the distance, or when that is many thresholds, a lower bound [m]
  double gap = 0;
  std::array<int, 2> near = {-1, -1};  ///< triangles where the pair nearly came nearest last
  double safe = 0;                     ///< farther apart than the threshold's aim before this s
};

struct Advance {
  double s = 0;                         ///< where the motion stands
  std::optional<PairBound> stopped_by;  ///< the pair that ended it
  bool iteration_limit = false;  ///< it ended for the number of steps that it took, not for a touch
};

/// A gap below this part of the threshold was pushed in, not slid.
inline constexpr double nearly_closed = 1.0 / 64;

/// Runs s from 0 to `end`, measuring each pair only when it is no longer known to be apart, and
/// stops at the first that comes within the threshold: deep in it, or where a pair that passes by
/// is nearest. `place(s)` must put the bodies where they are at s; it has done so on return. The
/// gap at a stop is in (0, threshold]. A pair that touches at the start stops the motion only when
/// its gap nearly closes.
/// watches  with a, b, speed and perhaps clear given; nothing collides at s = 0. On return `clear`
///          holds at s, the next start
/// queries  counts the distance queries made
/// max_steps  a motion that needs more grazes for metres within micrometres: it gives up where it
///            is
/// throws   Error when the bodies stand so far out that rounding hides the threshold
Advance advance(World& world, std::vector<PairBound>& watches, double end,
                const std::function<void(double)>& place, int& queries, int max_steps = 1000000);

}  // namespace clench
