// Depth order of coplanar surfaces.
#pragma once
#include <epoxy/gl.h>

namespace clench::gl {

/// During its lifetime, drawn surfaces are moved by a few steps of the depth buffer, backwards
/// (towards
/// > 0) or forwards (towards < 0), so that the same one of coplanar surfaces is always visible.
/// Steps exceed the rounding of vertices and of their positions in a pixel.
class DepthOffset {
 public:
  explicit DepthOffset(float towards) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(slope * towards, steps * towards);
  }
  ~DepthOffset() { glDisable(GL_POLYGON_OFFSET_FILL); }
  DepthOffset(const DepthOffset&) = delete;
  DepthOffset& operator=(const DepthOffset&) = delete;

 private:
  static constexpr float slope = 0.1f, steps = 32;
};

}  // namespace clench::gl
