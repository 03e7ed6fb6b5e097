// OpenGL 3.3 core without display, window or device file, for as long as this lives.
#pragma once

namespace clench {

/// Current on the calling thread from construction to destruction; what was current before is so
/// again after. Needs nothing but the libraries: EGL_PLATFORM_SURFACELESS_MESA of EGL 1.5.
class GlContext {
 public:
  /// throws Error that says what to install when there is no EGL or no OpenGL 3.3
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  void *old_display_ = nullptr, *old_context_ = nullptr, *old_draw_ = nullptr, *old_read_ = nullptr;
  unsigned old_api_ = 0;
};

}  // namespace clench
