// The time limit of a search.
#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "clench/script/lua/watching.h"

namespace clench {

/// Makes a request to the watcher of a script, once, after a time, unless it is closed before.
class Deadline {
 public:
  /// seconds  from now; at once if not above 0 [s]
  Deadline(std::shared_ptr<Bar> bar, double seconds, void (Bar::*request)() = &Bar::end_time);
  ~Deadline() { close(); }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  /// Ends the wait, and withdraws the deadline's own request; a stop that the user asked for
  /// remains.
  /// returns  true if the time has passed
  bool close();

 private:
  void wait(double seconds);

  std::shared_ptr<Bar> bar_;
  void (Bar::*request_)();
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false, passed_ = false;
  std::thread thread_;  // the last member: starts when all others are constructed
};

}  // namespace clench
