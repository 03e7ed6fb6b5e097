#include "clench/script/lua/deadline.h"

#include <algorithm>
#include <chrono>

namespace clench {

Deadline::Deadline(std::shared_ptr<Bar> bar, double seconds, void (Bar::*request)())
    : bar_(std::move(bar)), request_(request), thread_([this, seconds] { wait(seconds); }) {}

void Deadline::wait(double seconds) {
  // beyond the range of clocks
  constexpr double never = 1e9;
  const std::chrono::duration<double> time(std::clamp(seconds, 0.0, never));
  std::unique_lock lock(mutex_);
  const auto end = std::chrono::steady_clock::now() +
                   std::chrono::duration_cast<std::chrono::steady_clock::duration>(time);
  if (changed_.wait_until(lock, end, [this] { return closed_; })) return;
  passed_ = true;
  (*bar_.*request_)();
}

bool Deadline::close() {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return passed_;
    closed_ = true;
  }
  changed_.notify_one();
  thread_.join();
  if (passed_) bar_->take_end_of_time();
  return passed_;
}

}  // namespace clench
