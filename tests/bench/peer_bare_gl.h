// A scene's triangles drawn once by OpenGL and nothing else: a lower bound of the cost of a
// picture.
#pragma once
#include <memory>

#include "clench/scene/scene.h"

namespace clench::bench {

/// Creates context, program and buffers once; draws without light, shadow or smooth edges.
class BareGl {
 public:
  /// to_clip  transform from the world to clip space
  BareGl(const Scene& scene, const Eigen::Matrix4d& to_clip, int width, int height);
  ~BareGl();
  /// Draws and reads the pixels back.   returns  number of pixels that show a triangle
  int draw();
  /// Draws without reading back, and waits until the frame is complete.
  void draw_frame(const Eigen::Matrix4d& to_clip);

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

}  // namespace clench::bench
