// Draws picture after picture, and keeps what the next one needs again.
#pragma once
#include <memory>
#include <optional>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// A framebuffer that frames are drawn to, and the lower left corner of the frame in it [pixels].
struct DrawTarget {
  /// of the caller's context, complete, with 8 bits a channel; 0: its window. Empty: the renderer's
  /// own, whose frame `read` returns
  std::optional<unsigned> framebuffer = {};
  int x = 0, y = 0;
};

/// Keeps compiled programs, meshes on the graphics card, textures that it draws to, the shadow, and
/// the last scene of paper quality with its light: at most some 256 MB of meshes, one scene of up to
/// as much, and textures of the size of the last picture. A picture is the same, to the bit,
/// whatever was drawn before. Used by one thread at a time, any.
class Renderer {
 public:
  /// Its own context, without a window, is current only while it draws; then the one that was is so
  /// again. The caller's context is current whenever a member is called, and at the end; its state
  /// is left as it was.
  enum class Context { own, caller };

  explicit Renderer(Context context = Context::own);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// A picture with labels and caption.
  /// throws  Stopped, after which it is as good as new; Error as `render` does
  Picture draw(const Scene& scene, const RenderOptions& options, const Font& font);

  /// Draws a frame, without labels and caption, and does not wait for it: a draft with one sample a
  /// pixel. Where the backdrop is not a studio, colors are multiplied by alpha. Meshes that were
  /// drawn before are only moved.
  /// throws  as `draw`; Error on options of other pictures, and on a framebuffer where the context
  ///         is the renderer's own
  void draw_to(const DrawTarget& target, const Scene& scene, const Eye& eye,
               const RenderOptions& options);

  /// The last frame of the renderer's own framebuffer: the picture that `draw` returns, without
  /// labels and caption.
  /// throws  Error when there is none
  Picture read();

  /// Waits until frames are drawn.
  void finish();

  /// As `frame_all`; the last answer is kept.
  Eye frame_all(const Scene& scene, double aspect, bool ortho = false);

  /// that its meshes, scenes and textures take, about
  size_t bytes() const;
  /// Lets go of everything.
  void clear();

 private:
  struct Kept;
  struct Framed;
  class Entered;
  Kept& kept();

  Context context_;
  std::unique_ptr<Kept> kept_;
  std::unique_ptr<Framed> framed_;
};

}  // namespace clench
