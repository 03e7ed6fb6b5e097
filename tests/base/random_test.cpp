#include "clench/base/random.h"

#include <set>

using namespace clench;

TEST_CASE("the same seed and item give the same numbers, and other seeds or items give others") {
  Random a(1, 2), b(1, 2), c(1, 3), d(2, 2);
  std::set<uint64_t> firsts;
  for (int i = 0; i < 100; ++i) CHECK(a.bits() == b.bits());
  for (uint64_t item = 0; item < 1000; ++item) firsts.insert(Random(7, item).bits());
  CHECK(firsts.size() == 1000);
  CHECK(c.bits() != d.bits());
}

TEST_CASE("uniform numbers fill their range evenly") {
  Random random(5);
  int bins[10] = {};
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform(-1, 1);
    REQUIRE(x >= -1);
    REQUIRE(x < 1);
    ++bins[static_cast<int>((x + 1) * 5)];
  }
  // a bin holds 10000 with a standard deviation of 95; five of these
  for (const int count : bins) CHECK(std::abs(count - n / 10) < 5 * 95);
}

TEST_CASE("normal numbers have mean 0 and variance 1") {
  Random random(6);
  const int n = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    REQUIRE(std::isfinite(x));
    sum += x, squares += x * x;
  }
  // standard errors 0.0032 and 0.0045; five of these
  CHECK(std::abs(sum / n) < 0.016);
  CHECK(std::abs(squares / n - 1) < 0.023);
}
