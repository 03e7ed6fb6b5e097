// What an event loop waits for: descriptors, a time, and the bell of the state's jobs.
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

  /// throws  Error when the system has no descriptor left
  explicit Poller(std::shared_ptr<Bell> bell);
  ~Poller();
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;

  /// Readable when something of what is watched has come; a host's own loop may poll it.
  int descriptor() const { return set_; }

  /// Watches a descriptor in place of how it was watched before; for nothing: no longer.
  /// throws  Error when it is no open descriptor, or one of a kind that cannot be polled
  void watch(int descriptor, bool readable, bool writable);
  /// Makes `descriptor` readable after so long [s], once; below 0: never.
  void set_timer(double seconds);
  /// Waits at most so long [s]; below 0: until something comes. A signal ends the wait.
  /// returns  descriptors that are ready, at most 64; those that are closed on the other side count
  ///          as ready for whatever was asked
  std::vector<Ready> wait(double seconds);

 private:
  std::shared_ptr<Bell> bell_;
  int set_, timer_;
};

}  // namespace clench
