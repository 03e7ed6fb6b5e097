#include "clench/base/progress.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace clench;

namespace {

struct Record : Watcher {
  void show(double fraction, std::string_view text) override {
    fractions.push_back(fraction);
    last = text;
  }
  std::vector<double> fractions;
  std::string last;
};

}  // namespace

TEST_CASE("reported progress reaches the watcher") {
  const auto watcher = std::make_shared<Record>();
  const Progress progress(watcher);
  progress.tell(0.25, "first");
  progress.tell(-1, "not known");
  CHECK(watcher->fractions == std::vector<double>{0.25, -1});
  CHECK(watcher->last == "not known");
}

TEST_CASE(
    "a requested stop is thrown until it is taken, and progress without a watcher never stops") {
  const auto watcher = std::make_shared<Record>();
  const Progress progress(watcher);
  progress.check();
  watcher->stop();
  CHECK_THROWS_AS(progress.check(), Stopped);
  CHECK_THROWS_AS(progress.tell(1, "text"), Stopped);
  CHECK(watcher->fractions.empty());
  CHECK(watcher->take_stop());
  CHECK_FALSE(watcher->take_stop());
  progress.check();
  Progress().check();
  Progress().tell(0.5, "text");
}
