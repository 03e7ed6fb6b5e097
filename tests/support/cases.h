// Number of random cases under the sanitizers, which check memory and arithmetic rather than
// geometry.
#pragma once

namespace clench::test {

/// `count` random cases; under the sanitizers, which slow each down by a factor of twenty, an
/// eighth of them.
constexpr int cases(int count) {
#ifdef __SANITIZE_ADDRESS__
  return (count + 7) / 8;
#else
  return count;
#endif
}

}  // namespace clench::test
