// The cores of the machine, shared by all threads that run scripts concurrently with their callers.
#pragma once
#include <functional>

namespace clench {

/// Permission of the calling thread to compute, during the object's lifetime. There are as many as
/// cores, at least two, so that an endless job does not block all others. Threads that wait for
/// others lend theirs, so that nested levels of work share the cores.
class CoreSlot {
 public:
  enum class Start {
    wait,    ///< waits for a free one
    handed,  ///< takes the one that SlotLent hands over, or that was reserved
  };
  /// When `is_stopped` returns true it stops waiting and takes an additional one, so that stopped
  /// work ends immediately. A thread holds at most one.
  explicit CoreSlot(std::function<bool()> is_stopped, Start start = Start::wait);
  ~CoreSlot();
  CoreSlot(const CoreSlot&) = delete;
  CoreSlot& operator=(const CoreSlot&) = delete;

  /// Takes one, an additional one if none is free, for the thread that starts with Start::handed.
  static void reserve();
  /// The slot of the calling thread; null if it holds none.
  static CoreSlot* of_thread();
  /// Makes it available to other threads.
  /// returns  false if it was lent already
  bool lend();
  /// Hands it to the thread that starts with Start::handed.
  /// returns  as lend()
  bool hand_over();
  /// Waits until one is free again.
  void take_back();

 private:
  std::function<bool()> is_stopped_;
  bool lent_ = false;
};

/// Lends the slot of the calling thread, if it holds one, during the object's lifetime.
class SlotLent {
 public:
  /// any: any thread may take it; one: only that which starts with Start::handed
  enum class To { any, one };
  explicit SlotLent(To to = To::any) : slot_(CoreSlot::of_thread()) {
    if (slot_ && !(to == To::one ? slot_->hand_over() : slot_->lend())) slot_ = nullptr;
  }
  /// Did the thread hold one?
  bool is_lent() const { return slot_ != nullptr; }
  ~SlotLent() {
    if (slot_) slot_->take_back();
  }
  SlotLent(const SlotLent&) = delete;
  SlotLent& operator=(const SlotLent&) = delete;

 private:
  CoreSlot* slot_;
};

/// Lends the slot of the calling thread while a paused script holds it, for State::on_hold.
void lend_while_held(bool held);

}  // namespace clench
