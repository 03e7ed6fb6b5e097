// picture: what clench.render gives.
#pragma once
#include "render/picture.h"
#include "scene/scene.h"
#include "script/object.h"
#include "script/table.h"

namespace clench {

/// Reads size, samples and the camera, which must be all that is left of the options, and draws.
Picture draw_scene(Table& options, Scene scene);

extern const Class picture_class;
extern const Library render_library;

template <>
inline const Class& class_of<Picture>() {
  return picture_class;
}

inline size_t owned_bytes(const Picture& picture) { return picture.pixels.capacity(); }

}  // namespace clench
