#include "clench/render/render.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/render/canvas.h"
#include "clench/render/frame.h"
#include "clench/render/gl_context.h"
#include "clench/render/label_layout.h"
#include "clench/render/painter.h"

namespace clench {

// some minutes without graphics hardware
static constexpr int64_t max_drawn = int64_t{1} << 30;

Picture render(const Scene& scene, const RenderOptions& options, const Font& font) {
  for (const auto& [name, value] :
       {std::pair("width", options.width), std::pair("height", options.height)})
    if (value < 16 || value > 8192)
      fail("picture: {} must be between 16 and 8192 pixels, got {}", name, value);
  if (options.samples < 1 || options.samples > 256)
    fail("picture: samples must be between 1 and 256, got {}", options.samples);
  const int64_t drawn = int64_t{options.width} * options.height * options.samples;
  if (drawn > max_drawn)
    fail(ErrorKind::limit, "picture: expected at most {} pixels times samples, got {}", max_drawn,
         drawn);
  if (scene.eye) view_axes(*scene.eye);

  const DrawList list = make_draw_list(scene);
  const double aspect = static_cast<double>(options.width) / options.height;
  const Eye eye = scene.eye ? list.to_scene(*scene.eye) : frame(list, aspect);
  const GlContext context;
  Picture picture = paint(list, eye, options);
  Canvas canvas(picture, font);
  const Eigen::Vector2f size(options.width, options.height);
  for (const PlacedText& text : place_texts(scene, list.to_world(eye), size, font))
    canvas.bright_text({text.text, {text.box.low.x(), text.box.high.y()}, text.height}, text.color);
  return picture;
}

Eye frame_all(const Scene& scene, double aspect) {
  if (!(aspect > 0 && std::isfinite(aspect))) fail("picture: aspect must be > 0, got {}", aspect);
  const DrawList list = make_draw_list(scene);
  return list.to_world(frame(list, aspect));
}

}  // namespace clench
