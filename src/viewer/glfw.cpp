#include "clench/viewer/glfw.h"

#include <dlfcn.h>

#include "clench/base/error.h"

namespace clench {

namespace {

template <class Function>
void load_function(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (!function) fail("the viewer cannot open a window: libglfw.so.3 lacks {}", name);
}

Glfw load_glfw() {
  void* library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
  if (!library)
    fail(
        "the viewer cannot open a window: libglfw.so.3 was not found; install the package "
        "libglfw3");
  Glfw f{};
  load_function(library, "glfwInit", f.init);
  load_function(library, "glfwGetError", f.get_error);
  load_function(library, "glfwWindowHint", f.window_hint);
  load_function(library, "glfwCreateWindow", f.create_window);
  load_function(library, "glfwDestroyWindow", f.destroy_window);
  load_function(library, "glfwGetCurrentContext", f.current_context);
  load_function(library, "glfwMakeContextCurrent", f.make_current);
  load_function(library, "glfwSwapBuffers", f.swap_buffers);
  load_function(library, "glfwSwapInterval", f.swap_interval);
  load_function(library, "glfwPollEvents", f.poll_events);
  load_function(library, "glfwSetWindowTitle", f.set_title);
  load_function(library, "glfwGetWindowSize", f.window_size);
  load_function(library, "glfwGetFramebufferSize", f.framebuffer_size);
  load_function(library, "glfwGetWindowContentScale", f.content_scale);
  load_function(library, "glfwSetWindowShouldClose", f.set_should_close);
  load_function(library, "glfwSetWindowUserPointer", f.set_user_pointer);
  load_function(library, "glfwGetWindowUserPointer", f.user_pointer);
  load_function(library, "glfwSetCursorPosCallback", f.on_cursor);
  load_function(library, "glfwSetMouseButtonCallback", f.on_button);
  load_function(library, "glfwSetScrollCallback", f.on_scroll);
  load_function(library, "glfwSetKeyCallback", f.on_key);
  load_function(library, "glfwSetCharCallback", f.on_char);
  load_function(library, "glfwSetFramebufferSizeCallback", f.on_resize);
  load_function(library, "glfwSetWindowCloseCallback", f.on_close);
  load_function(library, "glfwSetDropCallback", f.on_drop);
  if (f.init() == GLFW_TRUE) return f;
  const char* reason = nullptr;
  f.get_error(&reason);
  fail(
      "the viewer cannot open a window: {}; clench.view.offscreen and clench.render need no "
      "display",
      reason ? reason : "there is no display");
}

}  // namespace

const Glfw& glfw() {
  static const Glfw loaded = load_glfw();
  return loaded;
}

const char* glfw_reason(const char* otherwise) {
  const char* reason = nullptr;
  glfw().get_error(&reason);
  return reason ? reason : otherwise;
}

}  // namespace clench
