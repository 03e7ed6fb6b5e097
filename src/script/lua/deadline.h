// The end of a search's time, as a stop that nobody has to ask for.
#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "clench/base/progress.h"

namespace clench {

/// Stops a watcher once, when so much time has passed, unless it is closed before.
class Deadline {
 public:
  /// seconds  from now; at once when not above 0 [s]
  Deadline(std::shared_ptr<Watcher> watcher, double seconds);
  ~Deadline() { close(); }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  /// Ends it; a stop of its own that nothing has heeded is withdrawn.
  /// returns  has the time passed?
  bool close();

 private:
  void wait(double seconds);

  std::shared_ptr<Watcher> watcher_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false, passed_ = false;
  std::thread thread_;  // the last member: begins when all else is there
};

}  // namespace clench
