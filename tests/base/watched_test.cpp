#include "clench/base/watched.h"

#include <doctest/doctest.h>

#include <thread>

using namespace clench;

namespace {

struct Silent : Watcher {
  void show(double, std::string_view) override {}
};

bool stops() {
  try {
    check_stop();
  } catch (const Stopped&) {
    return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a stop request ends work of a watched thread") {
  const auto watcher = std::make_shared<Silent>();
  CHECK_FALSE(stops());
  {
    const Watched watched{Progress(watcher)};
    CHECK_FALSE(stops());
    watcher->stop();
    CHECK(stops());
    CHECK(stops());
    bool elsewhere = true;
    std::thread([&] { elsewhere = stops(); }).join();
    CHECK_FALSE(elsewhere);
    watcher->take_stop();
    CHECK_FALSE(stops());
    watcher->stop();
  }
  CHECK_FALSE(stops());
}

TEST_CASE("the innermost watch counts, and an empty one protects its scope") {
  const auto watcher = std::make_shared<Silent>();
  watcher->stop();
  const Watched watched{Progress(watcher)};
  {
    const Watched protects{Progress()};
    CHECK_FALSE(stops());
    CHECK(protects.checks() == 1);
  }
  CHECK(stops());
  CHECK(watched.checks() == 1);
}

TEST_CASE("stop_at stops the check of the given number, once") {
  Watched watched{Progress()};
  watched.stop_at(3);
  CHECK_FALSE(stops());
  CHECK_FALSE(stops());
  CHECK(stops());
  CHECK_FALSE(stops());
}

TEST_CASE("a stop check of short rounds tests every tenth round") {
  const Watched watched{Progress()};
  StopCheck check(10);
  for (int i = 0; i < 95; ++i) check();
  CHECK(watched.checks() == 9);
}
