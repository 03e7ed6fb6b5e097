#include "clench/render/paint/draft_shadow.h"

#include <epoxy/gl.h>

#include <utility>

#include "clench/render/view/frame.h"
#include "clench/render/view/lights.h"

namespace clench {
namespace {

// half width of the map: the scene's ball and a margin [scene units]
constexpr double draft_reach = 1.03;

}  // namespace

void draw_triangles(const StoredMesh& mesh, bool one_side, int first, int count) {
  glBindVertexArray(mesh.array);
  if (one_side) glEnable(GL_CULL_FACE), glCullFace(GL_BACK);
  glDrawElements(GL_TRIANGLES, count < 0 ? mesh.count : count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(uint32_t)));
  if (one_side) glDisable(GL_CULL_FACE);
}

void DraftShadow::make(int size) {
  map_ = gl::make_shadow_maps(size, 1);
  target_ = gl::make_framebuffer({}, 0);
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, map_, 0, 0);
  size_ = size;
}

void DraftShadow::cast(const Programs& programs, const DraftScene& scene, int size,
                       const Progress& progress) {
  std::vector<Caster> casters;
  for (const PlacedMesh& placed : scene.solid)
    if (!placed.background) casters.push_back({placed.shape, placed.to_scene});
  const Eigen::Vector3d to_lamp =
      place_lamp(view_axes(scene.eye), 1).front().to_light.cast<double>().normalized();
  if (whole_ && size == size_ && to_lamp == to_lamp_ && casters == casters_) return;

  whole_ = false;
  if (size != size_) make(size);
  casters_ = std::move(casters);
  to_lamp_ = to_lamp;
  const Eigen::Vector3d across = to_lamp_.unitOrthogonal();
  axes_ << across.transpose(), to_lamp_.cross(across).transpose(), to_lamp_.transpose();
  axes_ /= draft_reach;
  draw(programs, scene, progress);
  whole_ = true;
}

void DraftShadow::draw(const Programs& programs, const DraftScene& scene,
                       const Progress& progress) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, size_, size_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip.topLeftCorner<3, 3>() = axes_;
  clip.row(2) *= -1;
  for (const PlacedMesh& placed : scene.solid) {
    if (placed.background) continue;
    progress.tell(0.4, "drawing");
    gl::set(programs.draft_shadow, "to_clip",
            Eigen::Matrix4f((clip * placed.to_scene).cast<float>()));
    draw_triangles(*placed.mesh, placed.mesh->closed);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void DraftShadow::give(unsigned program) const {
  gl::bind(program, "map", 0, map_, true);
  gl::set(program, "map_axes", std::vector{Eigen::Matrix3f(axes_.cast<float>())});
  gl::set(program, "to_lamp", Eigen::Vector3f(to_lamp_.cast<float>()));
  gl::set(program, "texel", static_cast<float>(2 * draft_reach / size_));
}

size_t DraftShadow::bytes() const { return sizeof(float) * size_ * size_; }

}  // namespace clench
