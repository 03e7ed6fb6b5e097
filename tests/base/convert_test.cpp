#include "clench/base/convert.h"

#include <doctest/doctest.h>

#include <cstdint>

using clench::floor_between;
using clench::floor_int;

TEST_CASE("a number of any size becomes an integer within its bounds") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(floor_between(2.9, 0, 5) == 2);
  CHECK(floor_between(-0.1, -3, 5) == -1);
  for (const double x : {5.0, 5.5, 1e300, infinity}) CHECK(floor_between(x, 0, 5) == 5);
  for (const double x : {0.0, -0.5, -1e300, -infinity, std::nan("")})
    CHECK(floor_between(x, 0, 5) == 0);
  CHECK(floor_int(1e10) == std::numeric_limits<int>::max());
  CHECK(floor_int(-1e10) == std::numeric_limits<int>::min());
}

TEST_CASE("the largest integers are reached and not exceeded") {
  using Limits = std::numeric_limits<int64_t>;
  CHECK(floor_between(0x1p63, Limits::min(), Limits::max()) == Limits::max());
  CHECK(floor_between(0x1p62, Limits::min(), Limits::max()) == int64_t{1} << 62);
  CHECK(floor_between(-0x1p63, Limits::min(), Limits::max()) == Limits::min());
  CHECK(floor_between(-0x1.8p63, Limits::min(), Limits::max()) == Limits::min());
}
