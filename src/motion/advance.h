// Conservative advancement of many pairs along one motion: how far can it go before the first touch?
// source  Mirtich (1996), ch. 2: a pair at distance d cannot meet within d / (bound of its speed)
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "model/find.h"

namespace clench {

/// A pair under watch while a parameter s runs from 0 to the end of a motion.
struct Watch {
  Id<Body> a, b;
  double speed =
      0;  ///< bound of the speed of any point of one relative to the other [m per unit of s]
  bool touching = false;  ///< within the threshold since the start: it may slide and leave
  double gap = 0;         ///< as last measured [m]
  double safe = 0;        ///< cannot meet before this s
};

struct Advance {
  double s = 0;  ///< where the motion stands
  std::optional<Watch> stopped_by;
};

/// A gap below this part of the threshold was pushed in, not slid.
inline constexpr double nearly_closed = 1.0 / 64;

/// Runs s from 0 to `end`, measuring each pair only when it is no longer known to be apart, and stops at the first
/// that comes within the threshold. `place(s)` must put the bodies where they are at s; it has done so on return.
/// The gap at a stop is in (0, threshold]. A pair that touches at the start stops the motion only when its gap
/// nearly closes.
/// watches  with a, b and speed > 0 given; nothing collides at s = 0
/// queries  counts the distance queries made
Advance advance(const World& world, std::vector<Watch>& watches, double end,
                const std::function<void(double)>& place, int& queries);

}  // namespace clench
