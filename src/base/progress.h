// Long work watched and stopped from outside.
#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace clench {

/// Thrown by long work that is asked to stop. Not an Error: handlers of errors do not catch it.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

/// Stores the progress of long work, and the request to stop it. Displays of it, such as the bar of
/// a terminal, derive from it or ask for it.
class Watcher {
 public:
  struct State {
    double fraction = -1;  ///< of the work that is done, in [0, 1]; below 0: not known
    std::string text;
  };

  virtual ~Watcher() = default;

  /// Stores the progress and displays it.   fraction  in [0, 1]; below 0: not known
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

  /// Asks for the end. May be called from any thread and from a signal handler.
  void stop() { stop_.store(true, std::memory_order_relaxed); }
  bool stop_asked() const { return stop_.load(std::memory_order_relaxed); }
  /// Was it asked for? From now on it is not.
  bool take_stop() { return stop_.exchange(false, std::memory_order_relaxed); }

 protected:
  /// Displays the progress, in the thread that does the work.
  virtual void show(double /*fraction*/, std::string_view /*text*/) {}

 private:
  std::atomic<bool> stop_ = false;
  mutable std::mutex mutex_;
  State state_;
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
    if (watcher_) watcher_->note(fraction, text);
  }

 private:
  std::shared_ptr<Watcher> watcher_;
};

}  // namespace clench
