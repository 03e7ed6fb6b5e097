// GLFW, loaded when the first window is opened: programs without windows need no window system.
#pragma once
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace clench {

/// The functions of GLFW that windows use.
struct Glfw {
  decltype(&glfwInit) init;
  decltype(&glfwGetError) get_error;
  decltype(&glfwWindowHint) window_hint;
  decltype(&glfwCreateWindow) create_window;
  decltype(&glfwDestroyWindow) destroy_window;
  decltype(&glfwGetCurrentContext) current_context;
  decltype(&glfwMakeContextCurrent) make_current;
  decltype(&glfwSwapBuffers) swap_buffers;
  decltype(&glfwSwapInterval) swap_interval;
  decltype(&glfwPollEvents) poll_events;
  decltype(&glfwSetWindowTitle) set_title;
  decltype(&glfwGetWindowSize) window_size;
  decltype(&glfwGetFramebufferSize) framebuffer_size;
  decltype(&glfwGetWindowContentScale) content_scale;
  decltype(&glfwSetWindowShouldClose) set_should_close;
  decltype(&glfwSetWindowUserPointer) set_user_pointer;
  decltype(&glfwGetWindowUserPointer) user_pointer;
  decltype(&glfwSetCursorPosCallback) on_cursor;
  decltype(&glfwSetMouseButtonCallback) on_button;
  decltype(&glfwSetScrollCallback) on_scroll;
  decltype(&glfwSetKeyCallback) on_key;
  decltype(&glfwSetCharCallback) on_char;
  decltype(&glfwSetFramebufferSizeCallback) on_resize;
  decltype(&glfwSetWindowCloseCallback) on_close;
  decltype(&glfwSetDropCallback) on_drop;
};

/// Loads GLFW and connects to the display, once for the process.
/// throws  Error if the library is not installed or there is no display
const Glfw& glfw();
/// Reason of the last failure of GLFW in this thread, or `otherwise`.
const char* glfw_reason(const char* otherwise);

}  // namespace clench
