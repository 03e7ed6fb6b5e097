// Third-party data and measurements, read in place; absent on most machines.
#pragma once
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

namespace clench::test {

/// The folder with data/ and reference/: CLENCH_SHARED, or ../shared from the project's root. Empty when absent.
inline std::filesystem::path shared() {
  const char* given = std::getenv("CLENCH_SHARED");
  const std::filesystem::path folder = given ? given : "../shared";
  return std::filesystem::is_directory(folder / "data") ? folder : std::filesystem::path();
}

}  // namespace clench::test

/// Ends the test case, saying so, where the third-party data is absent.
#define REQUIRE_SHARED()                                                       \
  if (clench::test::shared().empty()) {                                       \
    MESSAGE("skipped: no third-party data at ../shared or CLENCH_SHARED");    \
    return;                                                                    \
  }
