#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/viewer/glfw.h"
#include "clench/viewer/screen.h"

namespace clench {

namespace {

class Window final : public Screen {
 public:
  Window(int width, int height, const std::string& title) {
    glfw().window_hint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfw().window_hint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfw().window_hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    // frames call the renderer, whose context of EGL cannot be entered while one of GLX is current
    glfw().window_hint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    window_ = glfw().create_window(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
      glfw().window_hint(GLFW_CONTEXT_CREATION_API, GLFW_NATIVE_CONTEXT_API);
      window_ = glfw().create_window(width, height, title.c_str(), nullptr, nullptr);
    }
    if (!window_) fail("the viewer needs OpenGL 3.3: {}", glfw_reason("no window was created"));
    glfw().set_user_pointer(window_, this);
    listen();
  }
  ~Window() override { glfw().destroy_window(window_); }

  std::shared_ptr<void> enter() override {
    GLFWwindow* before = glfw().current_context();
    glfw().make_current(window_);
    return std::shared_ptr<void>(window_, [before](void*) { glfw().make_current(before); });
  }
  unsigned framebuffer() override { return 0; }
  int width() const override { return size().first; }
  int height() const override { return size().second; }
  double scale() const override {
    float x = 1, y = 1;
    glfw().content_scale(window_, &x, &y);
    return x;
  }
  void present() override { glfw().swap_buffers(window_); }
  void set_title(const std::string& title) override { glfw().set_title(window_, title.c_str()); }
  void poll(std::deque<InputEvent>& events) override {
    glfw().poll_events();
    for (InputEvent& event : waiting_) events.push_back(std::move(event));
    waiting_.clear();
  }

 private:
  using Kind = InputEvent::Kind;

  std::pair<int, int> size() const {
    int width = 0, height = 0;
    glfw().framebuffer_size(window_, &width, &height);
    return {width, height};
  }
  static void add(GLFWwindow* window, InputEvent event) {
    static_cast<Window*>(glfw().user_pointer(window))->waiting_.push_back(std::move(event));
  }
  // converts a position from screen coordinates to pixels
  static InputEvent at(GLFWwindow* window, double x, double y) {
    int width = 1, height = 1;
    glfw().window_size(window, &width, &height);
    const auto [pixels_x, pixels_y] = static_cast<Window*>(glfw().user_pointer(window))->size();
    return {.kind = Kind::move,
            .x = x * pixels_x / std::max(width, 1),
            .y = y * pixels_y / std::max(height, 1)};
  }
  void listen() {
    glfw().on_cursor(window_, [](GLFWwindow* w, double x, double y) { add(w, at(w, x, y)); });
    glfw().on_button(window_, [](GLFWwindow* w, int button, int action, int) {
      const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
      add(w, {.kind = Kind::button,
              .code = button,
              .down = action == GLFW_PRESS,
              .time = now.count()});
    });
    glfw().on_scroll(window_, [](GLFWwindow* w, double x, double y) {
      add(w, {.kind = Kind::wheel, .x = x, .y = y});
    });
    glfw().on_key(window_, [](GLFWwindow* w, int key, int, int action, int) {
      if (key >= 0 && action != GLFW_REPEAT)
        add(w, {.kind = Kind::key, .code = key, .down = action == GLFW_PRESS});
    });
    glfw().on_char(window_, [](GLFWwindow* w, unsigned c) {
      add(w, {.kind = Kind::text, .text = text_of(std::u32string(1, static_cast<char32_t>(c)))});
    });
    glfw().on_resize(window_, [](GLFWwindow* w, int x, int y) {
      add(w, {.kind = Kind::resize, .x = double(x), .y = double(y)});
    });
    glfw().on_close(window_, [](GLFWwindow* w) {
      glfw().set_should_close(w, GLFW_FALSE);  // closing is up to the program
      add(w, {.kind = Kind::close});
    });
    glfw().on_drop(window_, [](GLFWwindow* w, int count, const char** paths) {
      for (int i = 0; i < count; ++i) add(w, {.kind = Kind::drop, .text = paths[i]});
    });
  }

  GLFWwindow* window_ = nullptr;
  std::deque<InputEvent> waiting_;
};

}  // namespace

std::unique_ptr<Screen> make_window(int width, int height, const std::string& title) {
  Screen::check_size(width, height);
  return std::make_unique<Window>(width, height, title);
}

}  // namespace clench
