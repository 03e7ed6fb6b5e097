// Long work watched and stopped from outside.
#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <string_view>
#include <utility>

namespace clench {

/// Thrown by long work that is asked to stop. Not an Error: handlers of errors do not catch it.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

/// Displays the progress of long work, and stops it: the bar of a terminal, a button, a client.
class Watcher {
 public:
  virtual ~Watcher() = default;
  /// Work has come so far.   fraction  in [0, 1]; below 0: not known
  virtual void show(double fraction, std::string_view text) = 0;

  /// Asks for the end. May be called from any thread and from a signal handler.
  void stop() { stop_.store(true, std::memory_order_relaxed); }
  bool stop_asked() const { return stop_.load(std::memory_order_relaxed); }
  /// Was it asked for? From now on it is not.
  bool take_stop() { return stop_.exchange(false, std::memory_order_relaxed); }

 private:
  std::atomic<bool> stop_ = false;
};

/// Goes by value down every call that may take longer than a blink. An empty one is watched by
/// nobody.
class Progress {
 public:
  Progress() = default;
  explicit Progress(std::shared_ptr<Watcher> watcher) : watcher_(std::move(watcher)) {}

  bool stop_asked() const { return watcher_ && watcher_->stop_asked(); }
  /// throws Stopped when it was asked for
  void check() const {
    if (stop_asked()) throw Stopped();
  }
  /// So much of the work is done, in [0, 1]; below 0: not known.   throws Stopped as check
  void tell(double fraction, std::string_view text) const {
    check();
    if (watcher_) watcher_->show(fraction, text);
  }

 private:
  std::shared_ptr<Watcher> watcher_;
};

}  // namespace clench
