// The main function of all test programs. A test case that executes no assertion fails, unless it
// is marked as skipped.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <iostream>

#include "support/skip.h"

namespace clench::test {

namespace {

struct Tally {
  int skipped = 0, empty = 0;
  bool skips = false;  // the running test case
};
Tally tally;

struct Watcher : doctest::IReporter {
  explicit Watcher(const doctest::ContextOptions&) {}

  void test_case_start(const doctest::TestCaseData& data) override {
    name_ = data.m_name;
    tally.skips = false;
  }
  void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
    if (tally.skips) {
      ++tally.skipped;
    } else if (stats.numAssertsCurrentTest == 0 && stats.failure_flags == 0) {
      ++tally.empty;
      std::cout << "FAILED: '" << name_ << "' checks nothing\n";
    }
  }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  const char* name_ = "";
};

DOCTEST_REGISTER_LISTENER("watcher", 1, Watcher);

}  // namespace

void skip(const std::string& why) {
  tally.skips = true;
  std::cout << "skipped: " << why << '\n';
}

}  // namespace clench::test

int main(int argc, char** argv) {
  using clench::test::tally;
  const int result = doctest::Context(argc, argv).run();
  if (tally.skipped) std::cout << tally.skipped << " skipped\n";
  if (result != 0 || tally.empty) return 1;
  return tally.skipped ? clench::test::skip_code : 0;
}
