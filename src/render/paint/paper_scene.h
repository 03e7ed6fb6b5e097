// A scene on the graphics card with the light that was gathered for it: what pictures from several
// sides share.
#pragma once
#include <memory>
#include <optional>

#include "clench/render/mesh/draw_list.h"
#include "clench/render/paint/loaded_textures.h"
#include "clench/render/paint/shadows.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Lives inside the life of a GlContext, and of the programs.
class PaperScene {
 public:
  /// throws  Error as make_draw_list does
  PaperScene(const Programs& programs, const Scene& scene);

  const DrawList& list() const { return list_; }
  const LoadedCorners& loaded() const { return loaded_; }
  const LoadedTextures& textures() const { return textures_; }
  size_t bytes() const;

  /// Triangles that throw shadows, so many that fewer lights and one side of what is closed must
  /// do?
  bool heavy() const { return casters_ > 100000; }
  /// Light of a room that suits a picture of this size and smoothness, kept until another is asked
  /// for.
  /// throws  Stopped, and keeps what it had
  void light_room(const RenderOptions& options);
  /// That of a lamp as it stands for these axes of a view, at what is seen through.   throws
  /// Stopped
  void light_lamp(const Eigen::Matrix3d& axes, const Progress& progress);
  /// What all lights of the room return from a white floor with nothing in between.
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
