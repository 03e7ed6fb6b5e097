#include "clench/script/host/slots.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace clench {

namespace {

class FreeSlots {
 public:
  void take(const std::function<bool()>& is_stopped) {
    std::unique_lock lock(mutex_);
    while (free_ <= 0 && !is_stopped()) changed_.wait_for(lock, std::chrono::milliseconds(20));
    --free_;
  }
  void give() {
    const std::lock_guard lock(mutex_);
    ++free_;
    changed_.notify_one();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int free_ = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
};

FreeSlots& free_slots() {
  // never destroyed: threads may outlive the statics of the program
  static FreeSlots& all = *new FreeSlots;
  return all;
}

thread_local CoreSlot* slot_of_thread = nullptr;

}  // namespace

CoreSlot::CoreSlot(std::function<bool()> is_stopped, Start start)
    : is_stopped_(std::move(is_stopped)) {
  if (start == Start::wait) free_slots().take(is_stopped_);
  slot_of_thread = this;
}

CoreSlot::~CoreSlot() {
  slot_of_thread = nullptr;
  if (!lent_) free_slots().give();
}

void CoreSlot::reserve() {
  free_slots().take([] { return true; });
}

CoreSlot* CoreSlot::of_thread() { return slot_of_thread; }

bool CoreSlot::lend() {
  if (std::exchange(lent_, true)) return false;
  free_slots().give();
  return true;
}

bool CoreSlot::hand_over() { return !std::exchange(lent_, true); }

void CoreSlot::take_back() {
  if (!lent_) return;
  free_slots().take(is_stopped_);
  lent_ = false;
}

void lend_while_held(bool held) {
  CoreSlot* slot = CoreSlot::of_thread();
  if (!slot) return;
  if (held)
    slot->lend();
  else
    slot->take_back();
}

}  // namespace clench
