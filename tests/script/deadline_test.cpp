#include "clench/script/lua/deadline.h"

#include <doctest/doctest.h>

using namespace clench;

namespace {

class Quiet : public Watcher {
 public:
  void show(double, std::string_view) override {}
};

void wait_for_stop(const Watcher& watcher) {
  while (!watcher.stop_asked()) std::this_thread::yield();
}

}  // namespace

TEST_CASE("a deadline that has passed withdraws its own stop") {
  const auto watcher = std::make_shared<Quiet>();
  Deadline deadline(watcher, 0);
  wait_for_stop(*watcher);
  CHECK(deadline.close());
  CHECK_FALSE(watcher->stop_asked());
}

TEST_CASE("a stop that the user asked for remains after a deadline, whichever comes first") {
  for (const bool user_first : {true, false}) {
    const auto watcher = std::make_shared<Quiet>();
    if (user_first) watcher->stop();
    Deadline deadline(watcher, 0);
    while (!watcher->take_stop(StopCause::deadline)) std::this_thread::yield();
    watcher->stop(StopCause::deadline);
    if (!user_first) watcher->stop();
    CHECK(deadline.close());
    CHECK_FALSE(watcher->take_stop(StopCause::deadline));
    CHECK(watcher->take_stop());
  }
}

TEST_CASE("a deadline closed before its time asks for nothing") {
  const auto watcher = std::make_shared<Quiet>();
  Deadline deadline(watcher, 1e9);
  CHECK_FALSE(deadline.close());
  CHECK_FALSE(watcher->stop_asked());
}
