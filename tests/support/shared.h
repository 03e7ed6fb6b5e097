// Third-party data and measurements, read in place; absent on most machines.
#pragma once
#include <cstdlib>
#include <filesystem>

#include "support/skip.h"

namespace clench::test {

/// The folder with data/ and reference/: CLENCH_SHARED, or ../shared from the project's root. Empty
/// if absent.
inline std::filesystem::path shared() {
  const char* given = std::getenv("CLENCH_SHARED");
  const std::filesystem::path folder = given ? given : "../shared";
  return std::filesystem::is_directory(folder / "data") ? folder : std::filesystem::path();
}

}  // namespace clench::test

/// Ends the test case as skipped if the third-party data are absent.
#define REQUIRE_SHARED()                                                     \
  if (clench::test::shared().empty()) {                                      \
    clench::test::skip("no third-party data at ../shared or CLENCH_SHARED"); \
    return;                                                                  \
  }
