#include "clench/render/paint/draft.h"

#include <epoxy/gl.h>

#include <span>

#include "clench/render/figure/reduced.h"
#include "clench/render/gl/depth_offset.h"
#include "clench/render/gl/polygon_mode.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/paint/outline.h"
#include "clench/render/paint/tile.h"
#include "clench/render/view/frame.h"

namespace clench {
namespace {

constexpr int max_draft_map = 2048;  // [pixels]

GLenum mode_of(DrawStyle style) {
  if (style == DrawStyle::wireframe) return GL_LINE;
  return style == DrawStyle::points ? GL_POINT : GL_FILL;
}

class DraftPainter {
 public:
  DraftPainter(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
               const RenderOptions& options);
  /// draws to the cached target, except for most pixels of covered parts of the picture
  void paint(const Tile& tile, std::span<const PixelRect> covered = {});
  const Cover& cover() const { return cover_; }

 private:
  using Group = std::vector<PlacedMesh>;
  void draw(const PlacedMesh& placed, unsigned program, bool both_sides = false) const;
  void draw_textured(const PlacedMesh& placed, unsigned program, bool one_side) const;
  void light(unsigned program) const;
  void draw_solids() const;
  void draw_floor(const Tile& tile) const;
  void draw_behind(const Tile& tile) const;
  void draw_marks() const;
  void draw_glass() const;
  void lay_lines(const Group& group, bool hides) const;
  void give_backdrop(unsigned program, const Tile& tile) const;
  void set_up(const Tile& tile);
  bool has_faces() const { return options_.style == DrawStyle::faces; }
  void leave_out(const Tile& tile, std::span<const PixelRect> covered);
  template <class Draw>
  void in_parts(Draw draw) const;
  bool bare() const { return options_.backdrop != Backdrop::studio; }

  const Programs& programs_;
  DraftKept& kept_;
  const RenderOptions& options_;
  DraftScene scene_;
  Eigen::Matrix4d projection_, clip_;  // origin in the picture, and in the tile
  Cover cover_;
  std::vector<PixelRect> parts_;  // of the tile, which are drawn
};

DraftPainter::DraftPainter(const Programs& programs, DraftKept& kept, const Scene& scene,
                           const Eye& eye, const RenderOptions& options)
    : programs_(programs),
      kept_(kept),
      options_(options),
      scene_(load_draft(kept.meshes, kept.marks, scene, kept.extent.find(scene), eye,
                        options.progress)) {
  const Eigen::Vector2d depths = depth_range(scene_.eye);
  projection_ = view_projection(scene_.eye, static_cast<double>(options.width) / options.height,
                                depths[0], depths[1]);
  kept.shadow.cast(programs, scene_, map_size_for(options, 128, max_draft_map), options.progress);
}

void DraftPainter::draw(const PlacedMesh& placed, unsigned program, bool both_sides) const {
  gl::set(program, "to_scene", Eigen::Matrix4f(placed.to_scene.cast<float>()));
  gl::set(program, "to_clip", Eigen::Matrix4f((clip_ * placed.to_scene).cast<float>()));
  gl::set(program, "painted", placed.mesh->painted ? 1.0f : 0.0f);
  gl::set(program, "one_paint", placed.paint);
  const bool one_side = placed.one_side && !both_sides;
  const auto& textured = placed.mesh->textured;
  if (textured.empty() || programs_.on_image(program) == 0)
    return draw_triangles(*placed.mesh, one_side);
  draw_triangles(*placed.mesh, one_side, 0, textured.front().first);
  draw_textured(placed, programs_.on_image(program), one_side);
}

void DraftPainter::draw_textured(const PlacedMesh& placed, unsigned program, bool one_side) const {
  light(program);
  gl::set(program, "to_scene", Eigen::Matrix4f(placed.to_scene.cast<float>()));
  gl::set(program, "to_clip", Eigen::Matrix4f((clip_ * placed.to_scene).cast<float>()));
  gl::set(program, "one_paint", placed.paint);
  for (const TexturedRun& run : placed.mesh->textured) {
    placed.mesh->textures.give(program, run.texture);
    draw_triangles(*placed.mesh, one_side, run.first, run.count);
  }
}

// shader for bodies
void DraftPainter::light(unsigned program) const {
  kept_.shadow.give(program);
  gl::set(program, "eye", shading_eye(scene_.eye));
}

void DraftPainter::draw_solids() const {
  glDepthFunc(GL_LEQUAL);
  const gl::PolygonMode mode(mode_of(options_.style));
  for (const PlacedMesh& placed : scene_.solid) {
    options_.progress.tell(0.6, "drawing");
    draw(placed, programs_.draft, !has_faces());
  }
  glDepthFunc(GL_LESS);
}

void DraftPainter::give_backdrop(unsigned program, const Tile& tile) const {
  gl::set(program, "corner", Eigen::Vector2f(tile.x - tile.border, tile.y - tile.border));
  gl::set(program, "size", Eigen::Vector2f(options_.width, options_.height));
}

// draws what fills the tile only in the parts that are drawn
template <class Draw>
void DraftPainter::in_parts(Draw draw) const {
  glEnable(GL_SCISSOR_TEST);
  for (const PixelRect& part : parts_) {
    glScissor(part.x, part.y, part.width, part.height);
    draw();
  }
  glDisable(GL_SCISSOR_TEST);
}

void DraftPainter::draw_floor(const Tile& tile) const {
  if (!scene_.floor) return;
  kept_.shadow.give(programs_.draft_floor);
  give_backdrop(programs_.draft_floor, tile);
  gl::set(programs_.draft_floor, "bare", bare() ? 1.0f : 0.0f);
  const gl::DepthOffset behind_bodies(1);
  in_parts([&] { draw({.mesh = &*scene_.floor}, programs_.draft_floor); });
}

void DraftPainter::draw_behind(const Tile& tile) const {
  if (bare()) return;
  give_backdrop(programs_.draft_behind, tile);
  glDepthFunc(GL_LEQUAL);
  in_parts([&] { cover_.draw(programs_.draft_behind); });
  glDepthFunc(GL_LESS);
}

void DraftPainter::draw_marks() const {
  if (!scene_.marks) return;
  const PlacedMesh marks{.mesh = scene_.marks};
  draw(marks, programs_.draft_marks);
  lay_lines({marks}, false);
}

// far bodies first, each with its far side before its near one; they receive no shadow
void DraftPainter::draw_glass() const {
  const gl::PolygonMode mode(mode_of(options_.style));
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  {
    const gl::DepthOffset over_solids(-1);
    for (const PlacedMesh& placed : scene_.clear)
      for (const GLenum side : {GL_FRONT, GL_BACK}) {
        glCullFace(side);
        draw(placed, programs_.draft_glass, true);
      }
  }
  glDisable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  const gl::DepthOffset over_solids(-1);
  if (has_faces()) lay_lines(scene_.clear, false);
}

// outlines the group, drawn again, where earlier surfaces do not hide it
void DraftPainter::lay_lines(const Group& group, bool hides) const {
  const auto& lines = kept_.target->lines;
  if (!lines || group.empty()) return;
  glBindFramebuffer(GL_FRAMEBUFFER, lines->target);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  for (const PlacedMesh& one : group)
    if (!one.background) draw(one, programs_.draft_outline);
  glBindFramebuffer(GL_FRAMEBUFFER, kept_.target->target);
  glDisable(GL_DEPTH_TEST);
  Outline(programs_.outline, scene_.eye, options_)
      .draw({lines->places, lines->facings, lines->there}, hides ? 1.0f : 0.7f, true);
  glEnable(GL_DEPTH_TEST);
}

void DraftPainter::set_up(const Tile& tile) {
  const int width = tile.drawn_width(), height = tile.drawn_height();
  auto& target = kept_.target;
  if (!target || !target->fits(width, height, options_.outline > 0)) {
    target.reset();
    target.emplace(width, height, options_.outline > 0);
  }
  clip_ = crop_to(tile, options_) * projection_;
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 0);
  if (target->lines) {
    glBindFramebuffer(GL_FRAMEBUFFER, target->lines->target);
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target->target);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  for (const unsigned program : {unsigned(programs_.draft), unsigned(programs_.draft_glass),
                                 unsigned(programs_.draft_marks)})
    light(program);
}

// the depth of the nearest surface hides bodies, which are not shaded there
void DraftPainter::leave_out(const Tile& tile, std::span<const PixelRect> covered) {
  std::vector<PixelRect> left_out;
  for (const PixelRect& rect : covered) {
    const PixelRect inner = rect.without(smoothing_reach);
    if (inner.empty()) continue;
    left_out.push_back({inner.x - tile.x + tile.border, inner.y - tile.y + tile.border, inner.width,
                        inner.height});
  }
  parts_ = uncovered({0, 0, tile.drawn_width(), tile.drawn_height()}, left_out);
  glEnable(GL_SCISSOR_TEST);
  glClearDepth(0);
  for (const PixelRect& rect : left_out) {
    glScissor(rect.x, rect.y, rect.width, rect.height);
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  glClearDepth(1);
  glDisable(GL_SCISSOR_TEST);
}

void DraftPainter::paint(const Tile& tile, std::span<const PixelRect> covered) {
  options_.progress.check();
  set_up(tile);
  leave_out(tile, covered);
  draw_solids();
  draw_floor(tile);
  draw_behind(tile);
  if (has_faces()) lay_lines(scene_.solid, true);
  draw_marks();
  draw_glass();
}

void copy_tile(const Tile& tile, unsigned from, unsigned to) {
  const int first = tile.border;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(first, first, first + tile.width, first + tile.height, tile.x, tile.y,
                    tile.x + tile.width, tile.y + tile.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

size_t DraftKept::bytes() const {
  return meshes.bytes() + shadow.bytes() + (target ? target->bytes() : 0);
}

void draft_to(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
              const RenderOptions& options, const Destination& destination) {
  check(scene);
  DraftPainter drawing(programs, kept, scene, eye, options);
  const std::vector<Tile> tiles = tiles_of(options);
  if (tiles.size() == 1) {
    drawing.paint(tiles[0], destination.covered);
    smooth_to(programs.edges, drawing.cover(), kept.target->colors, options, destination);
  } else {
    const FrameTarget joined(options.width, options.height);
    for (const Tile& tile : tiles) {
      drawing.paint(tile, destination.covered);
      copy_tile(tile, kept.target->target, joined.target);
    }
    smooth_to(programs.edges, drawing.cover(), joined.pixels, options, destination);
  }
  check_driver();
}

Picture draft_reduced(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
                      const RenderOptions& options) {
  check(scene);
  RenderOptions large = options;
  large.width *= options.draft_scale, large.height *= options.draft_scale;
  large.outline *= options.draft_scale;
  Picture out = empty_picture(large);
  DraftPainter drawing(programs, kept, scene, eye, large);
  for (const Tile& tile : tiles_of(large)) {
    drawing.paint(tile);
    read_tile(tile, out);
  }
  check_driver();
  divide_by_alpha(out);
  return reduced(out, options.draft_scale);
}

Picture read_frame(const RenderOptions& options) {
  Picture out = empty_picture(options);
  read_tile({0, 0, options.width, options.height}, out);
  check_driver();
  divide_by_alpha(out);
  return out;
}

}  // namespace clench
