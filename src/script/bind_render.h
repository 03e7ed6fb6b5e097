// picture: what clench.render gives.
#pragma once
#include "render/picture.h"
#include "script/object.h"

namespace clench {

extern const Class picture_class;
extern const Library render_library;

template <>
inline const Class& class_of<Picture>() {
  return picture_class;
}

}  // namespace clench
