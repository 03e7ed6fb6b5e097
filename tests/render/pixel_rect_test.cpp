#include "clench/render/view/pixel_rect.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "clench/base/random.h"

using namespace clench;

TEST_CASE("each uncovered pixel is in exactly one rectangle, and no covered one is in any") {
  Random random(7);
  const auto number = [&](int low, int high) {
    return low + static_cast<int>(random.uniform() * (high - low + 1));
  };
  int covered_pixels = 0;
  for (int round = 0; round < 500; ++round) {
    const PixelRect whole{number(-3, 3), number(-3, 3), number(1, 12), number(1, 12)};
    std::vector<PixelRect> covered;
    for (int i = number(0, 4); i > 0; --i)
      covered.push_back({number(-6, 12), number(-6, 12), number(-1, 9), number(-1, 9)});
    const std::vector<PixelRect> rest = uncovered(whole, covered);
    int outside = 0;
    for (int y = -8; y < 24; ++y)
      for (int x = -8; x < 24; ++x) {
        const PixelRect here{x, y, 1, 1};
        const auto holds = [&](const PixelRect& r) { return !r.empty() && r.contains(here); };
        const bool is_covered = std::ranges::any_of(covered, holds);
        const auto times = std::ranges::count_if(rest, holds);
        if (times != (whole.contains(here) && !is_covered ? 1 : 0)) ++outside;
        covered_pixels += whole.contains(here) && is_covered;
      }
    CHECK(outside == 0);
  }
  CHECK(covered_pixels > 1000);
}
