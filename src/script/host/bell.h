// What jobs ring when they have something new for the state that started them.
#pragma once
#include <memory>

struct lua_State;

namespace clench {

/// Tells that jobs of a state have something new: a descriptor that can be polled.
class Bell {
 public:
  /// throws  Error when the system has no descriptor left
  Bell();
  ~Bell();
  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;

  /// Readable after `ring`, until `clear`.
  int descriptor() const { return descriptor_; }
  /// May be called from any thread.
  void ring();
  void clear();

 private:
  int descriptor_;
};

/// The bell of a state's jobs.
const std::shared_ptr<Bell>& bell_of(lua_State* L);

}  // namespace clench
