#include "clench/render/paint/draft_target.h"

namespace clench {
namespace {

// memory per pixel [bytes]
constexpr size_t color_bytes = 4, depth_bytes = 4, line_bytes = 16 + 8 + 4 + depth_bytes;

size_t pixels_of(int width, int height) { return static_cast<size_t>(width) * height; }

}  // namespace

DraftTarget::Lines::Lines(int width, int height)
    : places(gl::make_texture(gl::Format::rgba32f, width, height)),
      facings(gl::make_texture(gl::Format::rgba16f, width, height)),
      there(gl::make_texture(gl::Format::rgba8, width, height)),
      depths(gl::make_texture(gl::Format::depth, width, height)),
      target(gl::make_framebuffer({places, facings, there}, depths)) {}

DraftTarget::DraftTarget(int wide, int high, bool with_lines)
    : width(wide),
      height(high),
      colors(gl::make_texture(gl::Format::rgba8, wide, high)),
      depths(gl::make_texture(gl::Format::depth, wide, high)),
      target(gl::make_framebuffer({colors}, depths)) {
  if (with_lines) lines.emplace(wide, high);
}

size_t DraftTarget::bytes() const {
  return pixels_of(width, height) * (color_bytes + depth_bytes + (lines ? line_bytes : 0));
}

FrameTarget::FrameTarget(int wide, int high)
    : width(wide),
      height(high),
      pixels(gl::make_texture(gl::Format::rgba8, wide, high)),
      target(gl::make_framebuffer({pixels}, 0)) {}

size_t FrameTarget::bytes() const { return pixels_of(width, height) * color_bytes; }

}  // namespace clench
