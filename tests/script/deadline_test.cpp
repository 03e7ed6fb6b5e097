#include "clench/script/lua/deadline.h"

#include <doctest/doctest.h>

using namespace clench;

TEST_CASE("an expired deadline withdraws its own stop request") {
  const auto bar = std::make_shared<Bar>();
  Deadline deadline(bar, 0);
  while (!bar->stop_asked()) std::this_thread::yield();
  CHECK(deadline.close());
  CHECK_FALSE(bar->stop_asked());
}

TEST_CASE("an interrupt remains after a deadline, in either order") {
  for (const bool first : {true, false}) {
    CAPTURE(first);
    const auto bar = std::make_shared<Bar>();
    if (first) bar->interrupt();
    Deadline deadline(bar, 0);
    while (!bar->take_end_of_time()) std::this_thread::yield();
    bar->end_time();
    if (!first) bar->interrupt();
    CHECK(deadline.close());
    CHECK_FALSE(bar->take_end_of_time());
    CHECK(bar->stop_asked());
    CHECK(bar->take_all());
    CHECK_FALSE(bar->stop_asked());
  }
}

TEST_CASE("a deadline closed before its time requests no stop") {
  const auto bar = std::make_shared<Bar>();
  Deadline deadline(bar, 1e9);
  CHECK_FALSE(deadline.close());
  CHECK_FALSE(bar->stop_asked());
}
