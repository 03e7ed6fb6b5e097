// Test cases that cannot run here: a test that checked nothing must not look like one that passed.
#pragma once
#include <string>

namespace clench::test {

/// Marks the running test case as skipped, and says why; the caller returns then. A program in
/// which a case was skipped and none failed ends with skip_code, which ctest shows as Skipped.
void skip(const std::string& why);

inline constexpr int skip_code = 77;

}  // namespace clench::test
