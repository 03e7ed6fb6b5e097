// Stops for work that takes no Progress: walks over trees, factorizations, sorts, whatever lies
// deep below a call that is watched.
#pragma once
#include <cstdint>

#include "clench/base/progress.h"

namespace clench {

/// During its lifetime check_stop() on this thread asks its Progress; the innermost one counts. An
/// empty Progress protects work that must not be left half done.
/// Results do not change: work either ends as it would without it, or throws Stopped.
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

/// Throws Stopped when what watches this thread asks for the end. Takes some nanoseconds: call it
/// every few thousand operations, where nothing is left half done.
inline void check_stop() {
  if (Watched::innermost_) Watched::innermost_->check();
}

/// check_stop() at every `every`-th call: for loops whose rounds are short.
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
