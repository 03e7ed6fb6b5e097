// Progress of long work, and requests to stop it.
#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace clench {

/// Thrown by long work after a request to stop it. Not an Error: error handlers do not catch it.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

/// Stores the progress of long work, and the request to stop it. Displays, such as the progress bar
/// of a terminal, derive from it or poll it.
class Watcher {
 public:
  struct State {
    double fraction = -1;  ///< fraction of the work done, in [0, 1]; below 0: unknown
    std::string text;
  };

  virtual ~Watcher() = default;

  /// Stores the progress and displays it.
  /// fraction  in [0, 1]; below 0: unknown
  void note(double fraction, std::string_view text) {
    {
      const std::lock_guard lock(mutex_);
      state_.fraction = fraction;
      state_.text = text;
    }
    show(fraction, text);
  }
  /// May be called from any thread.
  State state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  /// Requests a stop. May be called from any thread and from a signal handler.
  void stop() { stop_.store(true, std::memory_order_relaxed); }
  bool stop_asked() const { return stop_.load(std::memory_order_relaxed); }
  /// Was a stop requested? Clears the request.
  bool take_stop() { return stop_.exchange(false, std::memory_order_relaxed); }

 protected:
  /// Displays the progress, in the thread that does the work.
  virtual void show(double /*fraction*/, std::string_view /*text*/) {}

 private:
  std::atomic<bool> stop_ = false;
  mutable std::mutex mutex_;
  State state_;
};

/// Passed by value to every function that may take noticeable time. An empty one reports nothing
/// and never stops.
class Progress {
 public:
  Progress() = default;
  explicit Progress(std::shared_ptr<Watcher> watcher) : watcher_(std::move(watcher)) {}

  bool stop_asked() const { return watcher_ && watcher_->stop_asked(); }
  /// throws Stopped if a stop was requested
  void check() const {
    if (stop_asked()) throw Stopped();
  }
  /// Reports the fraction of the work done, in [0, 1]; below 0: unknown.
  /// throws  Stopped as check
  void tell(double fraction, std::string_view text) const {
    check();
    if (watcher_) watcher_->note(fraction, text);
  }

 private:
  std::shared_ptr<Watcher> watcher_;
};

}  // namespace clench
