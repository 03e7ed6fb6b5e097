// The state of an OpenGL context that belongs to somebody else.
#pragma once
#include <memory>

namespace clench::gl {

/// While it lives, the current context has the state that pictures are drawn with: no scissor,
/// stencil, samplers, or buffers of pixels, whatever was set. After that, what drawing changes is as
/// it was.
class SavedState {
 public:
  SavedState();
  ~SavedState();
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;

 private:
  struct Values;
  std::unique_ptr<Values> values_;
};

}  // namespace clench::gl
