// A scene's triangles drawn once by OpenGL and nothing else: what a picture costs at least.
#pragma once
#include <memory>

#include "clench/scene/scene.h"

namespace clench::bench {

/// Context, program and buffers are made once; without light, shadow or smooth edges.
class BareGl {
 public:
  /// `to_clip`: of the world.
  BareGl(const Scene& scene, const Eigen::Matrix4d& to_clip, int width, int height);
  ~BareGl();
  /// Draws and reads the pixels back.   returns  how many show a triangle
  int draw();
  /// Draws without reading back, and waits until it is drawn.
  void draw_frame(const Eigen::Matrix4d& to_clip);

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

}  // namespace clench::bench
