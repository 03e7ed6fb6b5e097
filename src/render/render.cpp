#include "render/render.h"

#include <cmath>

#include "base/error.h"
#include "render/canvas.h"
#include "render/frame.h"
#include "render/gl_context.h"
#include "render/painter.h"

namespace clench {

namespace {

constexpr float label_part = 0.018f;  // height of letters, part of the picture's

// centred where its place is seen; what lies behind the eye is not
void write_label(const DrawLabel& label, const Eye& eye, Picture& picture) {
  const Eigen::Vector3d p = view_axes(eye).transpose() * (label.p_W - eye.eye);
  if (!(p.z() < 0)) return;
  const double pixels = 0.5 * picture.height / std::tan(eye.field_of_view / 2) / -p.z();
  const float height = std::max(9.0f, label_part * static_cast<float>(picture.height));
  const float x = static_cast<float>(0.5 * picture.width + pixels * p.x());
  const float y = static_cast<float>(0.5 * picture.height - pixels * p.y());
  Canvas(picture).text(label.text, {x - Canvas::text_width(label.text, height) / 2, y + height / 2},
                       height, label.color);
}

}  // namespace

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
  Picture picture = paint(list, eye, options);
  for (const DrawLabel& label : scene.labels) write_label(label, list.to_world(eye), picture);
  return picture;
}

}  // namespace clench
