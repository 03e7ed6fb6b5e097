#include "clench/viewer/screen.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "clench/base/error.h"
#include "clench/render/gl/gl_context.h"
#include "clench/render/gl/gl_objects.h"

namespace clench {

Picture Screen::read() {
  Picture picture;
  picture.width = width(), picture.height = height();
  const size_t row = size_t{3} * picture.width;
  std::vector<uint8_t> bottom_up(row * picture.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  picture.pixels.resize(bottom_up.size());
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(bottom_up.begin() + (picture.height - 1 - y) * row, row,
                picture.pixels.begin() + y * row);
  return picture;
}

std::string Screen::renderer() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "";
}

namespace {

class Offscreen final : public Screen {
 public:
  Offscreen(int width, int height) : width_(width), height_(height) {}
  ~Offscreen() override {
    try {
      const GlContext::Entered entered(context_);
      color_ = {}, framebuffer_ = {};
    } catch (const Error&) {
      // without the context its objects no longer exist
    }
  }

  std::shared_ptr<void> enter() override { return std::make_shared<GlContext::Entered>(context_); }
  unsigned framebuffer() override {
    if (!framebuffer_) {
      color_ = gl::make_texture(gl::Format::rgba8, width_, height_);
      framebuffer_ = gl::make_framebuffer({color_}, 0);
    }
    return framebuffer_;
  }
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  GlContext context_;
  int width_, height_;
  gl::Object color_, framebuffer_;
};

}  // namespace

void Screen::check_size(int width, int height) {
  for (const int n : {width, height})
    if (n < min_size || n > max_size)
      fail("size of the view: expected {} to {} pixels, got {}", min_size, max_size, n);
}

std::unique_ptr<Screen> make_offscreen(int width, int height) {
  Screen::check_size(width, height);
  return std::make_unique<Offscreen>(width, height);
}

}  // namespace clench
