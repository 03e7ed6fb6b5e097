// How much of a long test the sanitizers take: they look for faults of memory and arithmetic, not
// of geometry.
#pragma once

namespace clench::test {

/// `count` random cases; under the sanitizers, where each takes twenty times as long, an eighth of
/// them.
constexpr int cases(int count) {
#ifdef __SANITIZE_ADDRESS__
  return (count + 7) / 8;
#else
  return count;
#endif
}

}  // namespace clench::test
