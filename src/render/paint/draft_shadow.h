// The shadow of drafts: depths that their one lamp sees.
#pragma once
#include <vector>

#include "clench/render/gl/gl_objects.h"
#include "clench/render/gl/programs.h"
#include "clench/render/paint/draft_scene.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Draws indices of a mesh, `count` of them from `first` on; by default all.
/// one_side  draws only the side that faces the eye, which hides the other one of a closed mesh
void draw_triangles(const StoredMesh& mesh, bool one_side, int first = 0, int count = -1);

/// Kept until bodies that throw shadows, the lamp or the size change. Lives inside the life of a
/// GlContext.
class DraftShadow {
 public:
  /// The lamp stands beside the eye, so it moves with it; `size` of the map [pixels].
  /// throws  Stopped
  void cast(const Programs& programs, const DraftScene& scene, int size, const Progress& progress);
  /// The lamp and its map, for a program that has `draft_light_part`; takes texture unit 0.
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
  bool whole_ = false;  // the map holds what the key tells
};

}  // namespace clench
