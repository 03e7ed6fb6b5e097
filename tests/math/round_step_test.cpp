#include "clench/math/round_step.h"

#include <doctest/doctest.h>

using namespace clench;

TEST_CASE("a round step is the next of 1, 2 and 5 times powers of ten") {
  const double pairs[][2] = {{1, 1}, {1.01, 2}, {2, 2},       {3, 5},
                             {5, 5}, {5.1, 10}, {0.03, 0.05}, {700, 1000}};
  // powers of ten are not exact below 1
  for (const auto& [x, step] : pairs) CHECK(round_step(x) == doctest::Approx(step).epsilon(1e-12));
  for (double x = 1e-250; x < 1e250; x *= 3.7) {
    CHECK(round_step(x) >= x);
    CHECK(round_step(x) <= 2.5 * x * (1 + 1e-12));
  }
}
