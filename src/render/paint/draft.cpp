#include "clench/render/paint/draft.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clench/render/figure/smooth_edges.h"
#include "clench/render/gl/depth_offset.h"
#include "clench/render/mesh/draw_list.h"
#include "clench/render/mesh/extent.h"
#include "clench/render/mesh/outward.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/paint/outline.h"
#include "clench/render/paint/tile.h"
#include "clench/render/view/frame.h"
#include "clench/render/view/lights.h"

namespace clench {
namespace {

constexpr int max_draft_map = 2048;   // [pixels]
constexpr double draft_reach = 1.03;  // of the map: the scene's ball and a margin

// one mesh of the scene, where it stands
struct Placed {
  const StoredMesh* mesh;
  Eigen::Matrix4d to_scene;
  Eigen::Vector4f paint;
  bool background;
  double distance;        // of its centre from the eye, scene units
  bool one_side = false;  // is all that can be seen
};

Eigen::Matrix4d moved_by(const DrawMesh& mesh, const StoredMesh& stored, const Extent& extent) {
  Eigen::Matrix4d out = Eigen::Matrix4d::Identity();
  out.topLeftCorner<3, 3>() = mesh.X_WM.rotation.toRotationMatrix() * (stored.scale / extent.scale);
  out.topRightCorner<3, 1>() = (mesh.X_WM * stored.centre - extent.centre) / extent.scale;
  return out;
}

// colours were multiplied by alpha
void divide_by_alpha(Picture& picture) {
  for (size_t i = 0; i < picture.alpha.size(); ++i)
    for (size_t at = 3 * i; picture.alpha[i] > 0 && at < 3 * i + 3; ++at) {
      const int alpha = picture.alpha[i];
      picture.pixels[at] =
          static_cast<uint8_t>(std::min(255, (picture.pixels[at] * 255 + alpha / 2) / alpha));
    }
}

class DraftPainter {
 public:
  DraftPainter(const Programs& programs, MeshStore& store, const Scene& scene, const Eye& eye,
               const RenderOptions& options);
  void paint(const Tile& tile, Picture& out);

 private:
  void load(MeshStore& store, const Scene& scene);
  void load_marks(const Scene& scene);
  void load_floor(const Scene& scene);
  void cast();
  void draw_triangles(const StoredMesh& mesh, bool one_side) const;
  void draw_depth(const Placed& placed, const Eigen::Matrix4d& clip, bool one_side) const;
  void draw(const Placed& placed, unsigned program, const Eigen::Matrix4d& clip,
            bool both_sides = false) const;
  void draw_glass(const Eigen::Matrix4d& clip) const;
  void draw_marks(const Eigen::Matrix4d& clip) const;
  struct Seen;
  void lay_lines(const std::vector<Placed>& group, const Seen& seen, const Eigen::Matrix4d& clip,
                 unsigned target, bool hides) const;
  Placed placed_marks() const;
  void give_light(unsigned program) const;

  const Programs& programs_;
  const RenderOptions& options_;
  Extent extent_;
  Eye eye_;  // in scene units
  Eigen::Matrix4d projection_;
  std::vector<Placed> solid_, clear_;
  std::optional<StoredMesh> marks_, floor_;
  double ground_ = 0;
  Eigen::Vector3d to_lamp_;
  Eigen::Matrix3d map_axes_;
  int map_size_;
  gl::Object map_, map_target_;
  Cover cover_;
};

DraftPainter::DraftPainter(const Programs& programs, MeshStore& store, const Scene& scene,
                           const Eye& eye, const RenderOptions& options)
    : programs_(programs),
      options_(options),
      extent_(extent_of(scene)),
      eye_(extent_.to_scene(eye)),
      map_size_(map_size_for(options, 128, max_draft_map)) {
  const Eigen::Vector2d depths = depth_range(eye_);
  projection_ = view_projection(eye_, static_cast<double>(options.width) / options.height,
                                depths[0], depths[1]);
  load(store, scene);
  load_marks(scene);
  load_floor(scene);
  cast();
}

void DraftPainter::load(MeshStore& store, const Scene& scene) {
  for (const DrawMesh& mesh : scene.meshes) {
    if (!mesh.shape || mesh.opacity == 0) continue;
    options_.progress.tell(0.1, "drawing");
    const StoredMesh& stored = store.at(mesh);
    Placed placed{&stored, moved_by(mesh, stored, extent_), {}, mesh.background, 0};
    placed.paint << linear_rgb(mesh.color), mesh.opacity;
    placed.distance = (placed.to_scene.topRightCorner<3, 1>() - eye_.eye).norm();
    placed.one_side = stored.closed && hides_inside(placed.to_scene.topRightCorner<3, 1>(),
                                                    stored.scale / extent_.scale, eye_);
    (mesh.opacity >= solid_from || mesh.background ? solid_ : clear_).push_back(placed);
  }
  // near bodies first, so that light is found once for what is seen; those seen through last
  std::ranges::stable_sort(solid_, std::ranges::less{}, &Placed::distance);
  std::ranges::stable_sort(clear_, std::ranges::greater{}, &Placed::distance);
}

void DraftPainter::load_marks(const Scene& scene) {
  std::vector<Corner> corners;
  std::vector<uint32_t> indices;
  const auto add = [&](Piece piece) {
    for (auto& p : piece.p_W) p = (p - extent_.centre) / extent_.scale;
    share_corners(piece.p_W, piece.triangles, piece.colors, corners, indices);
  };
  for (const DrawCone& cone : scene.cones) add(cone_piece(cone));
  for (const DrawArrow& arrow : scene.arrows) add(arrow_piece(arrow));
  if (indices.empty()) return;
  marks_.emplace(corners, indices);
  marks_->painted = true;
}

void DraftPainter::load_floor(const Scene& scene) {
  if (!scene.ground) return;
  ground_ = (*scene.ground - extent_.centre.z()) / extent_.scale;
  if (std::abs(ground_) > floor_reach || shading_eye(eye_).z() <= ground_) return;
  const auto z = static_cast<float>(ground_), r = static_cast<float>(floor_reach);
  std::vector<Corner> corners;
  for (const auto& [x, y] :
       {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
    corners.push_back({{x, y, z}, {0, 0, 1}, {}});
  floor_.emplace(corners, std::vector<uint32_t>{0, 1, 2, 0, 2, 3});
}

// what the lamp sees of the bodies that throw shadows
void DraftPainter::cast() {
  to_lamp_ = place_lamp(view_axes(eye_), 1).front().to_light.cast<double>().normalized();
  const Eigen::Vector3d across = to_lamp_.unitOrthogonal();
  map_axes_ << across.transpose(), to_lamp_.cross(across).transpose(), to_lamp_.transpose();
  map_axes_ /= draft_reach;
  map_ = gl::make_shadow_maps(map_size_, 1);
  map_target_ = gl::make_framebuffer({}, 0);
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, map_, 0, 0);
  glViewport(0, 0, map_size_, map_size_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip.topLeftCorner<3, 3>() = map_axes_;
  clip.row(2) *= -1;
  const auto cast_one = [&](const Placed& placed) {
    options_.progress.tell(0.4, "drawing");
    draw_depth(placed, clip, placed.mesh->closed);
  };
  for (const Placed& placed : solid_)
    if (!placed.background) cast_one(placed);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void DraftPainter::give_light(unsigned program) const {
  gl::bind(program, "map", 0, map_, true);
  gl::set(program, "map_axes", std::vector{Eigen::Matrix3f(map_axes_.cast<float>())});
  gl::set(program, "to_lamp", Eigen::Vector3f(to_lamp_.cast<float>()));
  gl::set(program, "texel", static_cast<float>(2 * draft_reach / map_size_));
}

// of a closed mesh only the side that faces the eye can be nearest
void DraftPainter::draw_triangles(const StoredMesh& mesh, bool one_side) const {
  glBindVertexArray(mesh.array);
  if (one_side) glEnable(GL_CULL_FACE), glCullFace(GL_BACK);
  glDrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
  if (one_side) glDisable(GL_CULL_FACE);
}

void DraftPainter::draw_depth(const Placed& placed, const Eigen::Matrix4d& clip,
                              bool one_side) const {
  gl::set(programs_.draft_shadow, "to_clip",
          Eigen::Matrix4f((clip * placed.to_scene).cast<float>()));
  draw_triangles(*placed.mesh, one_side);
}

void DraftPainter::draw(const Placed& placed, unsigned program, const Eigen::Matrix4d& clip,
                        bool both_sides) const {
  gl::set(program, "to_scene", Eigen::Matrix4f(placed.to_scene.cast<float>()));
  gl::set(program, "to_clip", Eigen::Matrix4f((clip * placed.to_scene).cast<float>()));
  gl::set(program, "painted", placed.mesh->painted ? 1.0f : 0.0f);
  gl::set(program, "one_paint", placed.paint);
  draw_triangles(*placed.mesh, placed.one_side && !both_sides);
}

// far bodies first, and of each its far side; no shadow falls on them
void DraftPainter::draw_glass(const Eigen::Matrix4d& clip) const {
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  const gl::DepthOffset over_solids(-1);
  for (const Placed& placed : clear_)
    for (const GLenum side : {GL_FRONT, GL_BACK}) {
      glCullFace(side);
      draw(placed, programs_.draft_glass, clip, true);
    }
  glDisable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glDepthMask(GL_TRUE);
}

Placed DraftPainter::placed_marks() const {
  return {&*marks_, Eigen::Matrix4d::Identity(), {0, 0, 0, 1}, false, 0};
}

void DraftPainter::draw_marks(const Eigen::Matrix4d& clip) const {
  if (marks_) draw(placed_marks(), programs_.draft_marks, clip);
}

// what lines are found in, one sample a pixel
struct DraftPainter::Seen {
  explicit Seen(const Tile& tile)
      : places(texture(gl::Format::rgba32f, tile)),
        facings(texture(gl::Format::rgba16f, tile)),
        there(texture(gl::Format::rgba8, tile)),
        depths(texture(gl::Format::depth, tile)),
        target(gl::make_framebuffer({places, facings, there}, depths)) {
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  static gl::Object texture(gl::Format format, const Tile& tile) {
    return gl::make_texture(format, tile.drawn_width(), tile.drawn_height());
  }
  gl::Object places, facings, there, depths, target;
};

// drawn again, where what was drawn before does not hide it
void DraftPainter::lay_lines(const std::vector<Placed>& group, const Seen& seen,
                             const Eigen::Matrix4d& clip, unsigned target, bool hides) const {
  if (group.empty()) return;
  glBindFramebuffer(GL_FRAMEBUFFER, seen.target);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  for (const Placed& one : group)
    if (!one.background) draw(one, programs_.draft_outline, clip);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glDisable(GL_DEPTH_TEST);
  Outline(programs_.outline, eye_, options_)
      .draw({seen.places, seen.facings, seen.there}, hides ? 1.0f : 0.7f, true);
  glEnable(GL_DEPTH_TEST);
}

void DraftPainter::paint(const Tile& tile, Picture& out) {
  const int width = tile.drawn_width(), height = tile.drawn_height();
  const gl::Object colors = gl::make_texture(gl::Format::rgba8, width, height),
                   depths = gl::make_texture(gl::Format::depth, width, height),
                   target = gl::make_framebuffer({colors}, depths);
  const Eigen::Matrix4d clip = crop_to(tile, options_) * projection_;
  const bool bare = options_.backdrop != Backdrop::studio;
  const auto give_backdrop = [&](unsigned program) {
    gl::set(program, "corner", Eigen::Vector2f(tile.x - tile.border, tile.y - tile.border));
    gl::set(program, "size", Eigen::Vector2f(options_.width, options_.height));
  };

  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  for (const unsigned program : {unsigned(programs_.draft), unsigned(programs_.draft_glass),
                                 unsigned(programs_.draft_marks)}) {
    give_light(program);
    gl::set(program, "eye", shading_eye(eye_));
  }
  glDepthFunc(GL_LEQUAL);
  for (const Placed& placed : solid_) {
    options_.progress.tell(0.6, "drawing");
    draw(placed, programs_.draft, clip);
  }
  glDepthFunc(GL_LESS);
  if (floor_) {
    give_light(programs_.draft_floor);
    give_backdrop(programs_.draft_floor);
    gl::set(programs_.draft_floor, "bare", bare ? 1.0f : 0.0f);
    const gl::DepthOffset behind_bodies(1);
    draw({&*floor_, Eigen::Matrix4d::Identity(), {0, 0, 0, 1}, false, 0}, programs_.draft_floor,
         clip);
  }
  if (!bare) {
    give_backdrop(programs_.draft_behind);
    glDepthFunc(GL_LEQUAL);
    cover_.draw(programs_.draft_behind);
    glDepthFunc(GL_LESS);
  }
  std::optional<Seen> seen;
  if (options_.outline > 0) {
    seen.emplace(tile);
    lay_lines(solid_, *seen, clip, target, true);
  }
  draw_marks(clip);
  if (seen && marks_) lay_lines({placed_marks()}, *seen, clip, target, false);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_glass(clip);
  glDisable(GL_BLEND);
  if (seen) {
    const gl::DepthOffset over_solids(-1);
    lay_lines(clear_, *seen, clip, target, false);
  }

  glBindFramebuffer(GL_FRAMEBUFFER, target);
  read_tile(tile, out);
}

// the mean of squares of pixels, weighted by how much they cover
Picture reduced(const Picture& large, int scale) {
  Picture out{large.width / scale, large.height / scale, {}};
  const size_t count = static_cast<size_t>(out.width) * out.height;
  out.pixels.resize(3 * count);
  if (!large.alpha.empty()) out.alpha.resize(count);
  const int squares = scale * scale;
  for (size_t i = 0; i < count; ++i) {
    const size_t x = i % out.width * scale, y = i / out.width * scale;
    int sums[3] = {}, cover = 0;
    for (int k = 0; k < squares; ++k) {
      const size_t at = (y + k / scale) * large.width + x + k % scale;
      const int weight = large.alpha.empty() ? 255 : large.alpha[at];
      cover += weight;
      for (int c = 0; c < 3; ++c) sums[c] += weight * large.pixels[3 * at + c];
    }
    for (int c = 0; c < 3 && cover > 0; ++c)
      out.pixels[3 * i + c] = static_cast<uint8_t>((sums[c] + cover / 2) / cover);
    if (!out.alpha.empty()) out.alpha[i] = static_cast<uint8_t>((cover + squares / 2) / squares);
  }
  return out;
}

Picture draw_draft(const Programs& programs, MeshStore& store, const Scene& scene, const Eye& eye,
                   const RenderOptions& options) {
  Picture out = empty_picture(options);
  DraftPainter drawing(programs, store, scene, eye, options);
  for (const Tile& tile : tiles_of(options)) {
    options.progress.check();
    drawing.paint(tile, out);
  }
  if (options.draft_scale == 1) smooth_edges(out);
  divide_by_alpha(out);
  check_driver();
  return out;
}

}  // namespace

Picture draft(const Programs& programs, MeshStore& store, const Scene& scene, const Eye& eye,
              const RenderOptions& options) {
  check(scene);
  if (options.draft_scale == 1) return draw_draft(programs, store, scene, eye, options);
  RenderOptions large = options;
  large.width *= options.draft_scale, large.height *= options.draft_scale;
  large.outline *= options.draft_scale;
  return reduced(draw_draft(programs, store, scene, eye, large), options.draft_scale);
}

}  // namespace clench
