#include "clench/render/paint/edge_pass.h"

#include <epoxy/gl.h>

namespace clench {

void smooth_to(unsigned program, const Cover& cover, unsigned colors, const RenderOptions& options,
               const Destination& destination) {
  glBindFramebuffer(GL_FRAMEBUFFER, destination.framebuffer);
  glViewport(destination.x, destination.y, options.width, options.height);
  glDisable(GL_DEPTH_TEST);
  gl::bind(program, "pixels", 1, colors);
  gl::set(program, "window", Eigen::Vector2f(-destination.x, -destination.y));
  gl::set(program, "size", Eigen::Vector2f(options.width, options.height));
  gl::set(program, "bare", options.backdrop != Backdrop::studio ? 1.0f : 0.0f);
  const auto& [red, green, blue] = destination.channels;
  glColorMask(red, green, blue, GL_TRUE);
  const PixelRect whole{0, 0, options.width, options.height};
  glEnable(GL_SCISSOR_TEST);
  for (const PixelRect& part : uncovered(whole, destination.covered)) {
    glScissor(destination.x + part.x, destination.y + part.y, part.width, part.height);
    cover.draw(program);
  }
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace clench
