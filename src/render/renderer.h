// Renders successive pictures, and caches data that the next ones need.
#pragma once
#include <array>
#include <memory>
#include <optional>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/render/view/pixel_rect.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// A framebuffer to draw frames to, and the lower left corner of the frame in it [pixels].
struct DrawTarget {
  /// of the caller's context, complete, with 8 bits per channel; 0: its window. Empty: the
  /// renderer's own framebuffer, whose frame `read` returns
  std::optional<unsigned> framebuffer = {};
  int x = 0, y = 0;
  /// red, green and blue: those that are written; all of them in the renderer's own framebuffer
  std::array<bool, 3> channels = {true, true, true};
  /// parts of the frame whose pixels are not needed and may become undefined, which saves time
  std::vector<PixelRect> covered = {};
};

/// Caches compiled programs, meshes on the graphics card, render targets, the shadow, and the last
/// scene of paper quality with its light: at most some 256 MB of meshes, one scene of up to the
/// same size, and textures of the size of the last picture. Pictures do not depend on earlier ones,
/// bit-exactly. May be used by any thread, one at a time.
class Renderer {
 public:
  /// The renderer's own context, without a window, is current only while it draws; then the
  /// previous one is restored. A caller's context must be current whenever a member is called,
  /// including the destructor; its state is left unchanged.
  enum class Context { own, caller };

  explicit Renderer(Context context = Context::own);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Renders a picture with labels and caption.
  /// throws  Stopped, after which it remains usable; Error as `render` does
  Picture draw(const Scene& scene, const RenderOptions& options, const Font& font);

  /// Draws a frame, without labels and caption, and does not wait for it: a draft with one sample
  /// per pixel. Unless the backdrop is a studio, colors are premultiplied by alpha. Meshes drawn
  /// before are only moved.
  /// throws  as `draw`; Error if the options are not those of frames, and on a framebuffer if the
  ///         context is the renderer's own
  void draw_to(const DrawTarget& target, const Scene& scene, const Eye& eye,
               const RenderOptions& options);

  /// The last frame of the renderer's own framebuffer: the picture that `draw` returns, without
  /// labels and caption.
  /// throws  Error if there is none
  Picture read();

  /// Waits until all frames are drawn.
  void finish();

  /// As `frame_all`; the last result is cached.
  Eye frame_all(const Scene& scene, double aspect, bool ortho = false);

  /// approximate memory of its meshes, scenes and textures [bytes]
  size_t bytes() const;
  /// Frees all cached data.
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
