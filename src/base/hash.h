// A 64-bit fingerprint of state: equal bits give equal hashes on all platforms.
#pragma once
#include <bit>
#include <cstdint>
#include <string_view>

namespace clench {

/// Fowler-Noll-Vo 1a over 64-bit words, finished by an avalanche (source  Steele et al. (2014),
/// SplitMix64).
class Hasher {
 public:
  void add(uint64_t word) { state_ = (state_ ^ mix(word)) * 0x100000001b3u; }
  void add(double x) { add(std::bit_cast<uint64_t>(x)); }
  void add(std::string_view text) {
    add(static_cast<uint64_t>(text.size()));
    for (const char c : text) add(static_cast<uint64_t>(static_cast<unsigned char>(c)));
  }
  void add_flag(bool on) { add(static_cast<uint64_t>(on)); }
  uint64_t value() const { return mix(state_); }

  static constexpr uint64_t mix(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

 private:
  uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace clench
