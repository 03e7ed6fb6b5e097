// Numbers made whole: the one place where a double of any size becomes an integer.
#pragma once
#include <limits>

namespace clench {

/// The largest integer that is not above x, cut to [low, high]; low for what is no number. A cast
/// of what the type cannot hold is undefined.
template <class Integer>
Integer floor_between(double x, Integer low, Integer high) {
  if (!(x > static_cast<double>(low))) return low;
  if (x >= static_cast<double>(high)) return high;
  // a cast cuts towards 0, and takes a tenth of the time of a call of floor
  const auto cut = static_cast<Integer>(x);
  return cut - (static_cast<double>(cut) > x);
}

/// As above, cut to what an int holds.
inline int floor_int(double x) {
  return floor_between(x, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

}  // namespace clench
