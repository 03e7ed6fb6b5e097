// Render target of a user interface: an offscreen framebuffer or a window.
#pragma once
#include <deque>
#include <memory>
#include <string>

#include "clench/render/figure/picture.h"
#include "clench/viewer/event.h"

namespace clench {

class Screen {
 public:
  static constexpr int min_size = 16, max_size = 8192;  // [pixels]

  virtual ~Screen() = default;
  /// throws  Error if it is out of range
  static void check_size(int width, int height);
  /// Makes its OpenGL context current on this thread until the returned object is destroyed.
  virtual std::shared_ptr<void> enter() = 0;
  /// Framebuffer to draw into, while entered.
  virtual unsigned framebuffer() = 0;
  virtual int width() const = 0;   ///< [pixels]
  virtual int height() const = 0;  ///< [pixels]
  /// Ratio of the monitor's resolution to 96 dpi.
  virtual double scale() const { return 1; }
  /// Shows the drawn frame; call while entered.
  virtual void present() {}
  /// Appends events of the window system, without waiting.
  virtual void poll(std::deque<InputEvent>&) {}
  /// Title of the window.
  virtual void set_title(const std::string&) {}
  /// Name of its OpenGL renderer; call while entered.
  std::string renderer();
  /// The pixels drawn last; call while entered.
  Picture read();
};

/// throws  Error if the size is out of range, or there is no EGL or no OpenGL 3.3
std::unique_ptr<Screen> make_offscreen(int width, int height);
/// throws  Error if the size is out of range, or there is no display or no OpenGL 3.3
std::unique_ptr<Screen> make_window(int width, int height, const std::string& title);

}  // namespace clench
