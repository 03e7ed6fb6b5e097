// State of an OpenGL context that belongs to the caller.
#pragma once
#include <memory>

namespace clench::gl {

/// During its lifetime, the current context has the state that drawing assumes: no scissor,
/// stencil, sampler or pixel buffer, regardless of previous settings. The destructor restores all
/// state that drawing changes.
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
