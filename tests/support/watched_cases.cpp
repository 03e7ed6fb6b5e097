// Test cases of all outcomes, by which tests/scripts/watched_test.sh tests the main function.
#include <doctest/doctest.h>

#include "support/skip.h"

TEST_CASE("one that checks") { CHECK(true); }

TEST_CASE("one without a check") {}

TEST_CASE("one that cannot run here") { clench::test::skip("for an example"); }

TEST_CASE("one that fails before it is skipped") {
  CHECK(false);
  clench::test::skip("for an example");
}
