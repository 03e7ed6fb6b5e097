// OpenGL 3.3 core without display, window or device file.
#pragma once

namespace clench {

/// Current on a thread only where it is entered, so that any thread may use it, one at a time.
/// Needs nothing but the libraries: EGL_PLATFORM_SURFACELESS_MESA of EGL 1.5.
class GlContext {
 public:
  /// throws Error that says what to install when there is no EGL or no OpenGL 3.3
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Current on this thread as long as this lives; what was current before is so again after.
  class Entered {
   public:
    /// throws Error when the driver cannot
    explicit Entered(const GlContext& context);
    ~Entered();
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;

   private:
    void* display_;
    void *old_display_, *old_context_, *old_draw_, *old_read_;
    unsigned old_api_;
  };

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace clench
