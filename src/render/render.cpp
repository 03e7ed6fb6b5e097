#include "clench/render/render.h"

#include "clench/render/renderer.h"

namespace clench {

Picture render(const Scene& scene, const RenderOptions& options, const Font& font) {
  return Renderer().draw(scene, options, font);
}

Eye frame_all(const Scene& scene, double aspect, bool ortho) {
  return Renderer().frame_all(scene, aspect, ortho);
}

}  // namespace clench
