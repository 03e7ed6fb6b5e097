#include "clench/render/painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "clench/base/error.h"
#include "clench/render/frame.h"
#include "clench/render/shaders.h"
#include "clench/render/shadows.h"

namespace clench {
namespace {

constexpr int largest_tile = 1536;  // bounds the memory of a large picture [pixels]
constexpr int lamps_per_sample = 4, room_lights_per_sample = 16;
constexpr int room_map_size = 256;  // [pixels]

struct Tile {
  int x, y, width, height;  // in the picture, from its lower left corner
};

// what is drawn to, of a tile's size
struct Canvas {
  explicit Canvas(const Tile& tile);
  // what is seen first, and the framebuffer of these
  gl::Object places, facings, paints, depths, first;
  gl::Object light, lit;         // one pass
  gl::Object sum, added;         // all passes
  gl::Object pixels, developed;  // as a screen shows it
};

Canvas::Canvas(const Tile& tile) {
  using gl::Format;
  const auto texture = [&](Format format) {
    return gl::make_texture(format, tile.width, tile.height);
  };
  places = texture(Format::rgba32f);
  facings = texture(Format::rgba16f);
  paints = texture(Format::rgba8);
  depths = texture(Format::depth);
  first = gl::make_framebuffer({places, facings, paints}, depths);
  light = texture(Format::rgba16f);
  lit = gl::make_framebuffer({light}, depths);
  sum = texture(Format::rgba32f);
  added = gl::make_framebuffer({sum}, 0);
  pixels = texture(Format::rgba8);
  developed = gl::make_framebuffer({pixels}, 0);
}

class Painter {
 public:
  Painter(const DrawList& list, const Eye& eye, const RenderOptions& options);
  void paint(const Tile& tile, Picture& out);

 private:
  Eigen::Matrix4f to_clip(const Tile& tile, const Eigen::Vector2d& shift) const;
  void make_programs();
  void draw(const Batch& batch) const;
  void find_first(const Canvas& canvas, const Eigen::Matrix4f& clip);
  void shade(const Canvas& canvas, const Tile& tile);
  void lay_marks(const Eigen::Matrix4f& clip);
  void lay_clear(const Eigen::Matrix4f& clip);
  void add(const Canvas& canvas);

  const DrawList& list_;
  const Eye& eye_;
  RenderOptions options_;
  Eigen::Matrix4d projection_;
  std::vector<Light> lamp_;
  std::vector<Eigen::Vector2d> shifts_;
  float open_light_ = 0;
  double done_ = 0;  // pixels

  LoadedList loaded_;
  gl::Object sorted_;  // indices of what is seen through
  int sorted_count_ = 0;
  gl::Object first_, shade_, mark_, through_, add_, develop_;
  gl::Object room_light_, lamp_light_;  // gathered at the corners
  Cover cover_;
  Shadows shadows_;
};

// maps of the lamp about as fine as the picture
int map_size(const RenderOptions& options) {
  int size = 256;
  while (size < 1024 && size < std::max(options.width, options.height)) size *= 2;
  return size;
}

Painter::Painter(const DrawList& list, const Eye& eye, const RenderOptions& options)
    : list_(list),
      eye_(eye),
      options_(options),
      loaded_(list),
      shadows_(list, loaded_, map_size(options)) {
  const double aspect = static_cast<double>(options.width) / options.height;
  // all lies within a ball about the origin; the near plane comes as close as that allows
  const double distance = eye.eye.norm(), ball = 2 * floor_reach;
  const double near =
      std::max({5e-4, std::min(0.5 * (distance - 1), 0.02 * distance), distance - ball});
  projection_ = view_projection(eye, aspect, near, distance + ball);
  lamp_ = place_lamp(view_axes(eye), options.samples * lamps_per_sample);
  shifts_ = place_samples(options.samples);

  make_programs();
  const std::vector<uint32_t> sorted = back_to_front(list, eye.eye.cast<float>());
  sorted_count_ = static_cast<int>(sorted.size());
  sorted_ = gl::make_buffer(sorted.data(), sorted.size() * sizeof(uint32_t));
  // a small picture shows less of what many lights do
  const double fine = std::clamp(std::max(options.width, options.height) / 640.0, 0.25, 1.0);
  const auto room =
      place_room(std::clamp(int(options.samples * room_lights_per_sample * fine), 24, 512));
  Shadows coarse(list, loaded_, room_map_size);
  room_light_ = gather(list, coarse, room, options.progress);
  if (!list.clear.empty())
    lamp_light_ = gather(list, coarse, place_lamp(view_axes(eye), Shadows::most), options.progress);
  open_light_ = light_on_floor(room) + light_on_floor(lamp_);
}

void Painter::make_programs() {
  using namespace shaders;
  const std::string head = shader_head(lamps_per_sample), light = light_part, shade = shade_part;
  first_ = gl::make_program(head, surface_vertex, seen_fragment);
  shade_ = gl::make_program(head, cover_vertex, light + shade + backdrop_part + shade_fragment);
  mark_ = gl::make_program(head, surface_vertex, shade + mark_fragment);
  through_ = gl::make_program(head, surface_vertex, shade + through_fragment);
  add_ = gl::make_program(head, cover_vertex, add_fragment);
  develop_ = gl::make_program(head, cover_vertex, develop_fragment);
}

// the part of the picture that a tile shows, shifted by parts of a pixel
Eigen::Matrix4f Painter::to_clip(const Tile& tile, const Eigen::Vector2d& shift) const {
  Eigen::Matrix4d crop = Eigen::Matrix4d::Identity();
  crop(0, 0) = static_cast<double>(options_.width) / tile.width;
  crop(1, 1) = static_cast<double>(options_.height) / tile.height;
  crop(0, 3) = (options_.width - 2 * tile.x - tile.width + 2 * shift.x()) / tile.width;
  crop(1, 3) = (options_.height - 2 * tile.y - tile.height + 2 * shift.y()) / tile.height;
  return (crop * projection_).cast<float>();
}

void Painter::draw(const Batch& batch) const {
  glDrawElements(GL_TRIANGLES, batch.count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(batch.first * sizeof(uint32_t)));
}

// solid bodies and the floor, without the lamp
void Painter::find_first(const Canvas& canvas, const Eigen::Matrix4f& clip) {
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.first);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  gl::set(first_, "to_clip", clip);
  gl::set(first_, "floor_sign", 1.0f);
  gl::bind(first_, "room", 1, room_light_);
  glBindVertexArray(loaded_.array);
  for (const Batch& batch : list_.solid) draw(batch);
  for (const Batch& batch : list_.behind) draw(batch);
  // seen from below it would only be in the way
  if (list_.ground && eye_.eye.z() > *list_.ground) {
    gl::set(first_, "floor_sign", -1.0f);
    draw(list_.floor);
  }
}

void Painter::shade(const Canvas& canvas, const Tile& tile) {
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.lit);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  shadows_.give(shade_);
  // a sample sees a few points of the lamp, which stand for all
  gl::set(shade_, "power", static_cast<float>(options_.samples));
  gl::bind(shade_, "places", 1, canvas.places);
  gl::bind(shade_, "facings", 2, canvas.facings);
  gl::bind(shade_, "paints", 3, canvas.paints);
  gl::bind(shade_, "depths", 4, canvas.depths);
  gl::set(shade_, "eye", Eigen::Vector3f(eye_.eye.cast<float>()));
  gl::set(shade_, "open_light", open_light_);
  gl::set(shade_, "reach", static_cast<float>(floor_reach));
  gl::set(shade_, "corner", Eigen::Vector2f(tile.x, tile.y));
  gl::set(shade_, "size", Eigen::Vector2f(options_.width, options_.height));
  cover_.draw(shade_);
}

// the nearest side of each cone, over what lies behind it; hides what is seen through behind it
void Painter::lay_marks(const Eigen::Matrix4f& clip) {
  if (list_.marks.count == 0) return;
  gl::set(mark_, "to_clip", clip);
  gl::set(mark_, "eye", Eigen::Vector3f(eye_.eye.cast<float>()));
  glBindVertexArray(loaded_.array);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw(list_.marks);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw(list_.marks);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
}

// what is seen through, the farthest first, over what lies behind it
void Painter::lay_clear(const Eigen::Matrix4f& clip) {
  if (sorted_count_ == 0) return;
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl::set(through_, "to_clip", clip);
  gl::set(through_, "eye", Eigen::Vector3f(eye_.eye.cast<float>()));
  gl::set(through_, "to_lamp", lamp_.front().to_light);
  gl::bind(through_, "room", 1, room_light_);
  gl::bind(through_, "lamp", 2, lamp_light_);
  glBindVertexArray(loaded_.array);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, sorted_);
  glDrawElements(GL_TRIANGLES, sorted_count_, GL_UNSIGNED_INT, nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, loaded_.indices);
  glDisable(GL_BLEND);
}

void Painter::add(const Canvas& canvas) {
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.added);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  gl::bind(add_, "light", 1, canvas.light);
  gl::set(add_, "weight", 1.0f / static_cast<float>(options_.samples));
  cover_.draw(add_);
  glDisable(GL_BLEND);
}

void Painter::paint(const Tile& tile, Picture& out) {
  const Canvas canvas(tile);
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.added);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  for (int s = 0; s < options_.samples; ++s) {
    glFinish();  // or a stop would wait for all that was drawn before
    options_.progress.tell((done_ + double(s) / options_.samples * tile.width * tile.height) /
                               (double(out.width) * out.height),
                           "drawing");
    shadows_.cast(
        std::span(lamp_).subspan(static_cast<size_t>(s) * lamps_per_sample, lamps_per_sample));
    glViewport(0, 0, tile.width, tile.height);
    const Eigen::Matrix4f clip = to_clip(tile, shifts_[s]);
    find_first(canvas, clip);
    shade(canvas, tile);
    lay_marks(clip);
    lay_clear(clip);
    add(canvas);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.developed);
  gl::bind(develop_, "light", 1, canvas.sum);
  cover_.draw(develop_);

  done_ += double(tile.width) * tile.height;

  // rows from the bottom to rows from the top
  std::vector<uint8_t> pixels(4 * static_cast<size_t>(tile.width) * tile.height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      const size_t row = out.height - 1 - tile.y - y;
      std::memcpy(&out.pixels[3 * (row * out.width + tile.x + x)],
                  &pixels[4 * (static_cast<size_t>(y) * tile.width + x)], 3);
    }
}

}  // namespace

Picture paint(const DrawList& list, const Eye& eye, const RenderOptions& options) {
  Picture out{options.width, options.height, {}};
  out.pixels.resize(3 * static_cast<size_t>(out.width) * out.height);
  Painter painter(list, eye, options);
  for (int y = 0; y < out.height; y += largest_tile)
    for (int x = 0; x < out.width; x += largest_tile)
      painter.paint(
          {x, y, std::min(largest_tile, out.width - x), std::min(largest_tile, out.height - y)},
          out);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    fail(ErrorKind::internal, "picture: the OpenGL driver reports error {:#x}", error);
  return out;
}

}  // namespace clench
