#include "bench/report.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

using namespace clench::bench;

namespace {

// twice as fast as the other library, with equal answers
Report measured() {
  Report report;
  report.check(true, "an answer");
  report.add("near", "a cup", {{"ours", {1, 1, 2}}, {"theirs", {2, 2, 9}}});
  return report;
}

}  // namespace

TEST_CASE("a measured aim that is met passes") {
  const Report report = measured();
  CHECK(report.ratio("near", "theirs") == doctest::Approx(2));
  CHECK(report.judge({{"near", report.ratio("near", "theirs"), 2}}));
  CHECK_FALSE(report.judge({{"near", report.ratio("near", "theirs"), 3}}));
}

TEST_CASE("an aim without measurements is missed, in either direction") {
  const Report report = measured();
  CHECK(std::isnan(report.ratio("near", "a library that is not here")));
  CHECK(std::isnan(report.ratio("far", "theirs")));
  CHECK(std::isnan(report.ratio("near", "theirs", "a question that was not asked")));
  CHECK(std::isnan(report.mean("far")));
  CHECK_FALSE(report.judge({{"far", report.ratio("far", "theirs"), 2}}));
  CHECK_FALSE(report.judge({{"far", report.mean("far"), 2, true}}));
}

TEST_CASE("times of zero are no measurement") {
  Report report;
  report.check(true, "an answer");
  report.add("near", "a cup", {{"ours", {0}}, {"theirs", {2}}});
  CHECK_FALSE(report.judge({{"near", report.ratio("near", "theirs"), 2}}));
  CHECK_FALSE(report.judge({{"near", report.mean("near"), 2, true}}));
  CHECK(report.judge({{"failures, of which none are allowed", 0, 0, true}}));
}

TEST_CASE("a library without queries has no median") {
  Report report;
  report.check(true, "an answer");
  report.add("near", "a cup", {{"ours", {}}, {"theirs", {2}}});
  CHECK(std::isnan(report.ratio("near", "theirs")));
}

TEST_CASE("the check fails without compared answers, or if one differs") {
  CHECK_FALSE(Report().judge({}));
  Report report = measured();
  CHECK(report.judge({}));
  report.check(false, "1 and 2");
  CHECK_FALSE(report.judge({}));
}

TEST_CASE("a table that cannot be written is reported") {
  CHECK_FALSE(measured().write_csv("no/such/folder/table.csv"));
  CHECK_FALSE(measured().write_csv("/dev/full"));
}
