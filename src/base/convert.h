// Conversion of doubles of any size to integers.
#pragma once
#include <limits>

namespace clench {

/// The largest integer not above x, clamped to [low, high]; low for NaN. A cast of a value that the
/// type cannot represent is undefined.
template <class Integer>
Integer floor_between(double x, Integer low, Integer high) {
  if (!(x > static_cast<double>(low))) return low;
  if (x >= static_cast<double>(high)) return high;
  // a cast truncates towards 0, and takes a tenth of the time of a call of floor
  const auto cut = static_cast<Integer>(x);
  return cut - (static_cast<double>(cut) > x);
}

/// As above, clamped to the range of int.
inline int floor_int(double x) {
  return floor_between(x, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

}  // namespace clench
