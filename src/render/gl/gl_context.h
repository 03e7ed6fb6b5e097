// OpenGL 3.3 core without display, window or device file.
#pragma once

namespace clench {

/// Current on a thread only while entered, so that any thread may use it, one at a time. Needs
/// nothing but the libraries: EGL_PLATFORM_SURFACELESS_MESA of EGL 1.5.
class GlContext {
 public:
  /// throws Error that says what to install if EGL or OpenGL 3.3 is missing
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context current on this thread during its lifetime, then restores the previous one.
  class Entered {
   public:
    /// throws Error if the driver fails
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
