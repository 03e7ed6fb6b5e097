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

/// Who asks for a stop. Each cause is asked for and withdrawn separately.
enum class StopCause : unsigned char { user = 1, deadline = 2 };

/// Displays the progress of long work, and stops it: the bar of a terminal, a button, a client.
class Watcher {
 public:
  virtual ~Watcher() = default;
  /// Displays the progress.   fraction  in [0, 1]; below 0: not known
  virtual void show(double fraction, std::string_view text) = 0;

  /// Asks for a stop. May be called from any thread and from a signal handler.
  void stop(StopCause cause = StopCause::user) {
    causes_.fetch_or(bit(cause), std::memory_order_relaxed);
  }
  bool stop_asked() const { return causes_.load(std::memory_order_relaxed) != 0; }
  /// Withdraws all requests.   returns  was there one?
  bool take_stop() { return causes_.exchange(0, std::memory_order_relaxed) != 0; }
  /// Withdraws the request of one cause, and leaves the other.   returns  was there one?
  bool take_stop(StopCause cause) {
    const auto others = static_cast<unsigned char>(~bit(cause));
    return (causes_.fetch_and(others, std::memory_order_relaxed) & bit(cause)) != 0;
  }

 private:
  static constexpr unsigned char bit(StopCause cause) { return static_cast<unsigned char>(cause); }

  std::atomic<unsigned char> causes_ = 0;
};

/// Argument, by value, of every call that may take long. An empty one has no watcher.
class Progress {
 public:
  Progress() = default;
  explicit Progress(std::shared_ptr<Watcher> watcher) : watcher_(std::move(watcher)) {}

  bool stop_asked() const { return watcher_ && watcher_->stop_asked(); }
  /// throws Stopped if a stop was asked for
  void check() const {
    if (stop_asked()) throw Stopped();
  }
  /// Reports the part of the work that is done, in [0, 1]; below 0: not known.   throws Stopped as check
  void tell(double fraction, std::string_view text) const {
    check();
    if (watcher_) watcher_->show(fraction, text);
  }

 private:
  std::shared_ptr<Watcher> watcher_;
};

}  // namespace clench
