// Test cases that cannot run here: a test without checks must not look like a passed one.
#pragma once
#include <string>

namespace clench::test {

/// Marks the running test case as skipped, and prints the reason; the caller then returns. A
/// program with skipped and no failed cases ends with skip_code, which ctest shows as Skipped.
void skip(const std::string& why);

inline constexpr int skip_code = 77;

}  // namespace clench::test
