// Built-in images of MJCF textures.
#pragma once
#include <memory>
#include <string>

#include "clench/spec/skin.h"

namespace clench {

struct MjcfPattern {
  std::string kind, mark;     ///< as in the file
  int width = 1, height = 1;  ///< [pixels]
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = first, mark_color = first;  ///< 0..1
};

/// side  of a cube: x, -x, y, -y, z, -z; -1: a flat image
/// returns  null for an unknown kind
/// source  MuJoCo XML reference: texture/builtin, mark
std::shared_ptr<const Image> pattern_image(const MjcfPattern& pattern, int side);

}  // namespace clench
