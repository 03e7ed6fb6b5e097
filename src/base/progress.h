// Long work watched and stopped from outside.
#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <string_view>

namespace clench {

/// Somebody asked for the end of what runs. No Error: nothing was wrong, and whoever handles errors lets it pass.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

/// Who watches: the bar of a terminal, a button, a client.
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

/// Goes by value down every call that may take longer than a blink. An empty one is watched by nobody.
class Progress {
 public:
  Progress() = default;
  /// The work is this part of what is watched.
  explicit Progress(std::shared_ptr<Watcher> watcher, double from = 0, double to = 1)
      : watcher_(std::move(watcher)), from_(from), to_(to) {}

  bool stop_asked() const { return watcher_ && watcher_->stop_asked(); }
  /// throws Stopped when it was asked for
  void check() const {
    if (stop_asked()) throw Stopped();
  }
  /// So much of the work is done.   throws Stopped as check
  void tell(double fraction, std::string_view text) const {
    check();
    if (watcher_) watcher_->show(fraction < 0 ? fraction : from_ + (to_ - from_) * fraction, text);
  }
  /// That of a part of the work.
  Progress part(double from, double to) const {
    return Progress(watcher_, from_ + (to_ - from_) * from, from_ + (to_ - from_) * to);
  }

 private:
  std::shared_ptr<Watcher> watcher_;
  double from_ = 0, to_ = 1;
};

}  // namespace clench
