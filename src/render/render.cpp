#include "render/render.h"

#include "base/error.h"
#include "render/frame.h"
#include "render/gl_context.h"
#include "render/painter.h"

namespace clench {

Picture render(const Scene& scene, const RenderOptions& options) {
  for (const auto& [name, value] :
       {std::pair("width", options.width), std::pair("height", options.height)})
    if (value < 16 || value > 8192)
      fail("picture: {} must be between 16 and 8192 pixels, got {}", name, value);
  if (options.samples < 1 || options.samples > 256)
    fail("picture: samples must be between 1 and 256, got {}", options.samples);
  if (scene.eye) view_axes(*scene.eye);

  const DrawList list = make_draw_list(scene);
  const double aspect = static_cast<double>(options.width) / options.height;
  const Eye eye = scene.eye ? list.to_scene(*scene.eye) : frame(list, aspect);
  const GlContext context;
  return paint(list, eye, options);
}

}  // namespace clench
