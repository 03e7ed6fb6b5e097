// Waits for descriptors, a timer and the bell of a state's jobs.
#pragma once
#include <memory>
#include <vector>

#include "clench/script/host/bell.h"

namespace clench {

class Poller {
 public:
  enum class Event { readable, writable };
  struct Ready {
    int descriptor;
    Event event;
  };

  /// throws  Error if the system has no descriptor left
  explicit Poller(std::shared_ptr<Bell> bell);
  ~Poller();
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;

  /// Readable when a watched descriptor, the timer or the bell is ready; a host may poll it.
  int descriptor() const { return set_; }

  /// Sets the events for which a descriptor is watched; without any, it is no longer watched.
  /// throws  Error if it is not an open descriptor, or cannot be polled
  void watch(int descriptor, bool readable, bool writable);
  /// Makes `descriptor()` readable once, after `seconds` [s]; a time below 0 cancels the timer.
  void set_timer(double seconds);
  /// Waits at most `seconds` [s], or without limit if below 0. A signal ends the wait.
  /// returns  at most 64 ready descriptors; one that is closed on the other side counts as
  ///          readable and writable
  std::vector<Ready> wait(double seconds);

 private:
  std::shared_ptr<Bell> bell_;
  int set_, timer_;
};

}  // namespace clench
