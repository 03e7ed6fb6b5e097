#include "clench/render/gl/gl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>

#include "clench/base/error.h"

namespace clench {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  fail(
      "pictures need EGL and OpenGL 3.3, and {}; install the packages libegl1, libgl1 and "
      "libgl1-mesa-dri",
      why);
}

// epoxy ends the process if a library is missing, so that is checked first
void check_libraries() {
  if (!epoxy_has_egl()) refuse("libEGL.so.1 was not found");
  for (const char* name : {"libOpenGL.so.0", "libGL.so.1"})
    if (void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL)) {
      dlclose(library);
      return;
    }
  refuse("neither libOpenGL.so.0 nor libGL.so.1 was found");
}

}  // namespace

GlContext::GlContext() {
  check_libraries();
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    refuse("this EGL cannot draw without a display (EGL_MESA_platform_surfaceless)");
  // the display is shared by the process: other threads may use it, so it is never terminated
  EGLDisplay display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    refuse("EGL found no driver that draws without a display");
  const EGLenum old_api = eglQueryAPI();
  eglBindAPI(EGL_OPENGL_API);
  const EGLint expected[] = {EGL_CONTEXT_MAJOR_VERSION,
                             3,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, expected);
  eglBindAPI(old_api);
  if (context == EGL_NO_CONTEXT) refuse("the driver offers no OpenGL 3.3 core context");
  display_ = display;
  context_ = context;
}

GlContext::~GlContext() { eglDestroyContext(display_, context_); }

GlContext::Entered::Entered(const GlContext& context)
    : display_(context.display_),
      old_display_(eglGetCurrentDisplay()),
      old_context_(eglGetCurrentContext()),
      old_draw_(eglGetCurrentSurface(EGL_DRAW)),
      old_read_(eglGetCurrentSurface(EGL_READ)),
      old_api_(eglQueryAPI()) {
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_)) return;
  eglBindAPI(old_api_);
  refuse("the driver offers no OpenGL 3.3 core context");
}

GlContext::Entered::~Entered() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglBindAPI(old_api_);
  if (old_context_ != EGL_NO_CONTEXT)
    eglMakeCurrent(old_display_, old_draw_, old_read_, old_context_);
}

}  // namespace clench
