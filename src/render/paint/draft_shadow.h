// Shadow of drafts: a depth map seen from their single lamp.
#pragma once
#include <vector>

#include "clench/render/gl/gl_objects.h"
#include "clench/render/gl/programs.h"
#include "clench/render/paint/draft_scene.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Draws `count` indices of a mesh from `first` on; by default all.
/// one_side  draws only the side that faces the eye, which hides the other one of a closed mesh
void draw_triangles(const StoredMesh& mesh, bool one_side, int first = 0, int count = -1);

/// Cached until bodies that cast shadows, the lamp or the size change. Must not outlive its
/// GlContext.
class DraftShadow {
 public:
  /// The lamp is next to the eye and moves with it; `size` of the map [pixels].
  /// throws  Stopped
  void cast(const Programs& programs, const DraftScene& scene, int size, const Progress& progress);
  /// Sets the lamp and its map in a program that contains `draft_light_part`; uses texture unit 0.
  void give(unsigned program) const;
  size_t bytes() const;

 private:
  struct Caster {
    std::shared_ptr<const Shape> shape;
    Eigen::Matrix4d to_scene;
    bool operator==(const Caster&) const = default;
  };
  void make(int size);
  void draw(const Programs& programs, const DraftScene& scene, const Progress& progress) const;

  int size_ = 0;
  gl::Object map_, target_;
  std::vector<Caster> casters_;
  Eigen::Vector3d to_lamp_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Zero();
  bool whole_ = false;  // does the map match the key?
};

}  // namespace clench
