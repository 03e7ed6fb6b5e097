// Stop requests for work that takes no Progress argument: tree traversals, factorizations, sorts
// and other low-level work.
#pragma once
#include <cstdint>

#include "clench/base/progress.h"

namespace clench {

/// During its lifetime check_stop() on this thread checks its Progress; the innermost one is used.
/// An empty Progress protects work that must not be interrupted. Results do not change: work either
/// completes as it would without it, or throws Stopped.
class Watched {
 public:
  explicit Watched(Progress progress) : progress_(std::move(progress)), outer_(innermost_) {
    innermost_ = this;
  }
  ~Watched() { innermost_ = outer_; }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  /// Number of calls of check_stop() so far.
  uint64_t checks() const { return checks_; }
  /// Makes the call of check_stop() with this number, counted from 1, throw Stopped.
  void stop_at(uint64_t check) { stop_at_ = check; }

 private:
  friend void check_stop();
  void check() {
    if (++checks_ == stop_at_ || progress_.stop_asked()) throw Stopped();
  }

  static thread_local constinit Watched* innermost_;
  Progress progress_;
  Watched* outer_;
  uint64_t checks_ = 0, stop_at_ = 0;
};

/// Throws Stopped if the Progress that watches this thread has a stop request. Takes some
/// nanoseconds: call it every few thousand operations, at points where work can be interrupted.
inline void check_stop() {
  if (Watched::innermost_) Watched::innermost_->check();
}

/// Calls check_stop() at every `every`-th call, for loops with short iterations.
class StopCheck {
 public:
  explicit StopCheck(uint32_t every) : every_(every) {}
  void operator()() {
    if (++count_ < every_) return;
    count_ = 0;
    check_stop();
  }

 private:
  uint32_t every_, count_ = 0;
};

}  // namespace clench
