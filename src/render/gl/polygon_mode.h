// Drawing of triangles as faces, edges or corners.
#pragma once
#include <epoxy/gl.h>

namespace clench::gl {

/// During its lifetime, triangles are drawn as GL_FILL, GL_LINE or GL_POINT.
class PolygonMode {
 public:
  explicit PolygonMode(GLenum mode) {
    glPolygonMode(GL_FRONT_AND_BACK, mode);
    glPointSize(point_size);
  }
  ~PolygonMode() { glPolygonMode(GL_FRONT_AND_BACK, GL_FILL); }
  PolygonMode(const PolygonMode&) = delete;
  PolygonMode& operator=(const PolygonMode&) = delete;

 private:
  static constexpr float point_size = 3;  // [pixels]
};

}  // namespace clench::gl
