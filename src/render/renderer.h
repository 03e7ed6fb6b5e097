// Draws picture after picture, and keeps what the next one needs again.
#pragma once
#include <memory>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// Keeps the OpenGL context, compiled programs, meshes on the graphics card, and the last scene of
/// paper quality with its light: at most some 256 MB of meshes and one scene of up to as much. A
/// picture is the same, to the bit, whatever was drawn before. Used by one thread at a time, any;
/// leaves what OpenGL context is current as it was.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// throws  Stopped, after which it is as good as new; Error as `render` does
  Picture draw(const Scene& scene, const RenderOptions& options, const Font& font);

  /// As `frame_all`; the last answer is kept.
  Eye frame_all(const Scene& scene, double aspect, bool ortho = false);

  /// that its meshes and scenes take, about
  size_t bytes() const;
  /// Lets go of everything.
  void clear();

 private:
  struct Kept;
  struct Framed;
  std::unique_ptr<Kept> kept_;
  std::unique_ptr<Framed> framed_;
};

}  // namespace clench
