// picture: what clench.render gives.
#pragma once
#include "render/lettering.h"
#include "render/picture.h"
#include "scene/scene.h"
#include "script/object.h"
#include "script/table.h"

namespace clench {

/// Reads size, samples and the camera, which must be all that is left of the options, and draws.
Picture draw_scene(lua_State* L, Table& options, Scene scene);

/// Logs why pictures have no letters, if they have none: once a Lua state.
void warn_without_letters(lua_State* L, const Font& font);

extern const Class picture_class;
extern const Library render_library;

template <>
inline const Class& class_of<Picture>() {
  return picture_class;
}

inline size_t owned_bytes(const Picture& picture) { return picture.pixels.capacity(); }

}  // namespace clench
