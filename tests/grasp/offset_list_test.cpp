#include "clench/grasp/wrench/offset_list.h"

#include <algorithm>
#include <vector>

#include "clench/base/random.h"

using namespace clench;

TEST_CASE(
    "the minimum of added and removed offsets equals that of a plain search, with the lowest index "
    "of equals") {
  Random random(1);
  OffsetList list;
  for (int round = 0; round < 3; ++round) {
    list.clear();
    CHECK(list.least() == -1);
    std::vector<double> plain;
    for (int step = 0; step < 3000; ++step) {
      const size_t many = round < 2 ? 400 : 20000;  // more than one group of blocks
      const size_t index = random.bits() % (step < 200 ? 40 : many);
      const double none = std::numeric_limits<double>::infinity();
      if (plain.size() <= index) plain.resize(index + 1, none);
      // few different values, so that several are minimal
      const double offset = static_cast<double>(random.bits() % 50) - 10;
      const bool drop = random.bits() % 3 == 0;
      if (drop)
        list.drop(static_cast<int>(index));
      else
        list.set(static_cast<int>(index), offset);
      plain[index] = drop ? none : offset;
      const auto least = std::min_element(plain.begin(), plain.end());
      REQUIRE(list.least() == (*least == none ? -1 : static_cast<int>(least - plain.begin())));
    }
  }
}

TEST_CASE("an offset may be replaced by a larger one") {
  OffsetList list;
  list.set(3, 1);
  list.set(7, 2);
  list.set(3, 5);
  CHECK(list.least() == 7);
  list.drop(1000);  // never present
  list.drop(7);
  CHECK(list.least() == 3);
}
