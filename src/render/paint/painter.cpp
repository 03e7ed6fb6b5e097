#include "clench/render/paint/painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "clench/render/gl/depth_offset.h"
#include "clench/render/mesh/outward.h"
#include "clench/render/paint/outline.h"
#include "clench/render/paint/tile.h"
#include "clench/render/view/frame.h"
#include "clench/render/view/lights.h"

namespace clench {
namespace {

// render targets, of a tile's size
struct Layers {
  explicit Layers(const Tile& tile);
  // first visible surfaces, and their framebuffer
  gl::Object places, facings, paints, depths, first;
  gl::Object light, lit;         // one pass
  gl::Object sum, added;         // sum of all passes
  gl::Object pixels, developed;  // display colors
};

Layers::Layers(const Tile& tile) {
  using gl::Format;
  const auto texture = [&](Format format) {
    return gl::make_texture(format, tile.drawn_width(), tile.drawn_height());
  };
  places = texture(Format::rgba32f);
  facings = texture(Format::rgba32f);
  paints = texture(Format::rgba8);
  depths = texture(Format::depth);
  first = gl::make_framebuffer({places, facings, paints}, depths);
  light = texture(Format::rgba32f);
  lit = gl::make_framebuffer({light}, depths);
  sum = texture(Format::rgba32f);
  added = gl::make_framebuffer({sum}, 0);
  pixels = texture(Format::rgba8);
  developed = gl::make_framebuffer({pixels}, 0);
}

class Painter {
 public:
  Painter(const Programs& programs, PaperScene& scene, const Eye& eye,
          const RenderOptions& options);
  void paint(const Tile& tile, Picture& out);

 private:
  void draw(int first, int count) const;
  void draw(const Batch& batch) const { draw(batch.first, batch.count); }
  void draw_seen(const Batch& batch, const Eigen::Matrix4f& clip) const;
  void find_first(const Layers& layers, const Eigen::Matrix4f& clip);
  void find_group(std::span<const Batch> group, const Layers& solid, const Layers& layers,
                  const Eigen::Matrix4f& clip, const Tile& tile);
  void shade(const Layers& layers, const Tile& tile);
  void lay_marks(const Eigen::Matrix4f& clip);
  void lay_clear(const Eigen::Matrix4f& clip);
  void add(const Layers& layers);

  const Programs& programs_;
  const DrawList& list_;
  const LoadedCorners& loaded_;
  const LoadedTextures& textures_;
  const Eye& eye_;
  Eigen::Vector3f shading_eye_;
  RenderOptions options_;
  Eigen::Matrix4d projection_;
  bool heavy_;
  int lamps_;  // lights per sample
  std::vector<Light> lamp_;
  std::vector<Eigen::Vector2d> shifts_;
  float open_light_ = 0;
  double done_ = 0;  // pixels done

  gl::Object sorted_;  // indices of transparent triangles
  std::vector<TexturedRun> sorted_runs_;
  Cover cover_;
  Shadows shadows_;
};

Painter::Painter(const Programs& programs, PaperScene& scene, const Eye& eye,
                 const RenderOptions& options)
    : programs_(programs),
      list_(scene.list()),
      loaded_(scene.loaded()),
      textures_(scene.textures()),
      eye_(eye),
      shading_eye_(shading_eye(eye)),
      options_(options),
      heavy_(scene.heavy()),
      lamps_(heavy_ ? lamps_per_sample / 2 : lamps_per_sample),
      shadows_(programs, map_size_for(options, 256, 1024), lamps_per_sample) {
  const double aspect = static_cast<double>(options.width) / options.height;
  const Eigen::Vector2d depths = depth_range(eye);
  projection_ = view_projection(eye, aspect, depths[0], depths[1]);
  lamp_ = place_lamp(view_axes(eye), options.samples * lamps_);
  shifts_ = place_samples(options.samples);

  const SortedTriangles sorted = back_to_front(list_, eye);
  sorted_runs_ = sorted.runs;
  sorted_ = gl::make_buffer(sorted.indices.data(), sorted.indices.size() * sizeof(uint32_t));
  scene.light_room(options);
  if (!list_.clear.empty()) scene.light_lamp(view_axes(eye), options.progress);
  open_light_ = scene.open_room() + light_on_floor(lamp_);
}

void Painter::draw(int first, int count) const {
  glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(uint32_t)));
}

// draws an opaque body by the program `first`, which is current before and after
void Painter::draw_seen(const Batch& batch, const Eigen::Matrix4f& clip) const {
  draw(batch.first, batch.plain_count);
  if (batch.textured.empty()) return;
  const unsigned program = programs_.on_image(programs_.first);
  gl::set(program, "to_clip", clip);
  gl::set(program, "floor_sign", 1.0f);
  for (const TexturedRun& run : batch.textured) {
    textures_.give(program, run.texture);
    draw(run.first, run.count);
  }
  gl::use(programs_.first);
}

// draws opaque bodies and the floor, without the lamp
void Painter::find_first(const Layers& layers, const Eigen::Matrix4f& clip) {
  glBindFramebuffer(GL_FRAMEBUFFER, layers.first);
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  gl::set(programs_.first, "to_clip", clip);
  gl::set(programs_.first, "floor_sign", 1.0f);
  glBindVertexArray(loaded_.array);
  for (const auto* batches : {&list_.solid, &list_.behind})
    for (const Batch& batch : *batches) {
      const bool one_side =
          heavy_ && batch.closed && hides_inside(batch.center, batch.radius, eye_);
      (one_side ? glEnable : glDisable)(GL_CULL_FACE);
      draw_seen(batch, clip);
    }
  glDisable(GL_CULL_FACE);
  // a floor seen from below would hide the scene
  if (list_.ground && shading_eye_.z() > *list_.ground) {
    gl::set(programs_.first, "floor_sign", -1.0f);
    const gl::DepthOffset behind_bodies(1);
    draw(list_.floor);
  }
}

// finds the surfaces of a group, for its outlines, where nothing opaque hides it
void Painter::find_group(std::span<const Batch> group, const Layers& solid, const Layers& layers,
                         const Eigen::Matrix4f& clip, const Tile& tile) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, solid.first);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, layers.first);
  const int width = tile.drawn_width(), height = tile.drawn_height();
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, layers.first);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glClear(GL_COLOR_BUFFER_BIT);
  gl::set(programs_.first, "to_clip", clip);
  gl::set(programs_.first, "floor_sign", 1.0f);
  glBindVertexArray(loaded_.array);
  for (const Batch& batch : group) draw(batch);
  glDepthMask(GL_FALSE);
  glBindFramebuffer(GL_FRAMEBUFFER, solid.lit);
}

void Painter::shade(const Layers& layers, const Tile& tile) {
  glBindFramebuffer(GL_FRAMEBUFFER, layers.lit);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  shadows_.give(programs_.shade);
  // each sample uses a few points of the lamp, at the power of all
  gl::set(programs_.shade, "power", static_cast<float>(options_.samples));
  gl::bind(programs_.shade, "places", 1, layers.places);
  gl::bind(programs_.shade, "facings", 2, layers.facings);
  gl::bind(programs_.shade, "paints", 3, layers.paints);
  gl::bind(programs_.shade, "depths", 4, layers.depths);
  gl::set(programs_.shade, "eye", shading_eye_);
  gl::set(programs_.shade, "open_light", open_light_);
  gl::set(programs_.shade, "reach", static_cast<float>(floor_reach));
  gl::set(programs_.shade, "corner", Eigen::Vector2f(tile.x - tile.border, tile.y - tile.border));
  gl::set(programs_.shade, "size", Eigen::Vector2f(options_.width, options_.height));
  gl::set(programs_.shade, "bare", options_.backdrop == Backdrop::studio ? 0.0f : 1.0f);
  cover_.draw(programs_.shade);
}

// draws the nearest side of each cone over the surfaces behind it, and hides transparent ones there
void Painter::lay_marks(const Eigen::Matrix4f& clip) {
  if (list_.marks.count == 0) return;
  gl::set(programs_.mark, "to_clip", clip);
  gl::set(programs_.mark, "eye", shading_eye_);
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

// draws transparent triangles, the farthest first, over the surfaces behind them
void Painter::lay_clear(const Eigen::Matrix4f& clip) {
  if (sorted_runs_.empty()) return;
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const auto prepare = [&](unsigned program) {
    gl::set(program, "to_clip", clip);
    gl::set(program, "eye", shading_eye_);
    gl::set(program, "to_lamp", lamp_.front().to_light);
    return program;
  };
  const unsigned plain = prepare(programs_.through),
                 textured = list_.textures.empty() ? 0 : prepare(programs_.on_image(plain));
  glBindVertexArray(loaded_.array);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, sorted_);
  const gl::DepthOffset over_solids(-1);
  for (const TexturedRun& run : sorted_runs_) {
    const bool has_image = run.texture >= 0;
    gl::use(has_image ? textured : plain);
    if (has_image) {
      textures_.give(textured, run.texture);
      gl::set(textured, "opacity", run.opacity);
    }
    draw(run.first, run.count);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, loaded_.indices);
  glDisable(GL_BLEND);
}

void Painter::add(const Layers& layers) {
  glBindFramebuffer(GL_FRAMEBUFFER, layers.added);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  gl::bind(programs_.add, "light", 1, layers.light);
  gl::set(programs_.add, "weight", 1.0f / static_cast<float>(options_.samples));
  cover_.draw(programs_.add);
  glDisable(GL_BLEND);
}

void Painter::paint(const Tile& tile, Picture& out) {
  const Layers layers(tile);
  const Outline lines(programs_.outline, eye_, options_);
  // transparent bodies and cones have separate outlines
  const std::optional<Layers> group =
      options_.outline > 0 ? std::optional<Layers>(tile) : std::nullopt;
  const auto find = [&](std::span<const Batch> batches, const Eigen::Matrix4f& clip) {
    if (group && !batches.empty() && batches.front().count > 0)
      find_group(batches, layers, *group, clip, tile);
  };
  const auto lay_lines = [&](std::span<const Batch> batches) {
    if (!group || batches.empty() || batches.front().count == 0) return;
    glDisable(GL_DEPTH_TEST);
    lines.draw({group->places, group->facings, group->paints}, 0.7f, false);
  };
  glBindFramebuffer(GL_FRAMEBUFFER, layers.added);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  for (int s = 0; s < options_.samples; ++s) {
    glFinish();  // otherwise a stop would wait for all earlier commands
    options_.progress.tell((done_ + double(s) / options_.samples * tile.width * tile.height) /
                               (double(out.width) * out.height),
                           "drawing");
    shadows_.cast(list_, loaded_,
                  std::span(lamp_).subspan(static_cast<size_t>(s) * lamps_, lamps_));
    glViewport(0, 0, tile.drawn_width(), tile.drawn_height());
    const Eigen::Matrix4f clip = (crop_to(tile, options_, shifts_[s]) * projection_).cast<float>();
    find_first(layers, clip);
    shade(layers, tile);
    if (options_.outline > 0) lines.draw({layers.places, layers.facings, layers.paints}, 1, false);
    // found before they hide themselves
    const std::span marks(&list_.marks, 1);
    find(marks, clip);
    lay_marks(clip);
    lay_lines(marks);
    lay_clear(clip);
    {
      const gl::DepthOffset over_solids(-1);
      find(list_.clear, clip);
    }
    lay_lines(list_.clear);
    add(layers);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, layers.developed);
  gl::bind(programs_.develop, "light", 1, layers.sum);
  cover_.draw(programs_.develop);
  done_ += double(tile.width) * tile.height;
  read_tile(tile, out);
}

}  // namespace

Picture paint(const Programs& programs, PaperScene& scene, const Eye& eye,
              const RenderOptions& options) {
  Picture out = empty_picture(options);
  Painter painter(programs, scene, eye, options);
  for (const Tile& tile : tiles_of(options)) painter.paint(tile, out);
  check_driver();
  return out;
}

}  // namespace clench
