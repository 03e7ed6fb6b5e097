// A descriptor by which jobs wake the state that started them.
#pragma once
#include <memory>

struct lua_State;

namespace clench {

/// An eventfd that becomes readable when a job of a state sends an event, shows a value or ends.
class Bell {
 public:
  /// throws  Error if the system has no descriptor left
  Bell();
  ~Bell();
  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;

  /// Readable after `ring`, until `clear`.
  int descriptor() const { return descriptor_; }
  /// May be called from any thread.
  void ring();
  /// Makes the descriptor unreadable until the next `ring`.
  void clear();

 private:
  int descriptor_;
};

/// The bell of a state's jobs, created at the first call.
/// throws  Error if the system has no descriptor left
const std::shared_ptr<Bell>& bell_of(lua_State* L);

}  // namespace clench
