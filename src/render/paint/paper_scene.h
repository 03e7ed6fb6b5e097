// A scene on the graphics card with the light gathered for it, shared by pictures from several
// sides.
#pragma once
#include <memory>
#include <optional>

#include "clench/render/mesh/draw_list.h"
#include "clench/render/paint/loaded_textures.h"
#include "clench/render/paint/shadows.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Must not outlive its GlContext and the programs.
class PaperScene {
 public:
  /// throws  Error as make_draw_list does
  PaperScene(const Programs& programs, const Scene& scene);

  const DrawList& list() const { return list_; }
  const LoadedCorners& loaded() const { return loaded_; }
  const LoadedTextures& textures() const { return textures_; }
  size_t bytes() const;

  /// Do so many triangles cast shadows that fewer lights, and one side of closed bodies, are used?
  bool heavy() const { return casters_ > 100000; }
  /// Gathers light of a room for a picture of this size and smoothness; cached until another is
  /// requested.
  /// throws  Stopped, and keeps the previous light
  void light_room(const RenderOptions& options);
  /// Gathers light of the lamp at these axes of a view, at transparent surfaces.
  /// throws  Stopped
  void light_lamp(const Eigen::Matrix3d& axes, const Progress& progress);
  /// Light of all lights of the room reflected by an unoccluded white floor.
  float open_room() const { return open_room_; }

 private:
  const Programs& programs_;
  DrawList list_;
  LoadedCorners loaded_;
  LoadedTextures textures_;
  Shadows coarse_;
  size_t casters_ = 0;
  int room_count_ = 0;
  float open_room_ = 0;
  std::optional<Eigen::Matrix3d> lamp_axes_;
  gl::Object room_, lamp_;
};

}  // namespace clench
