// Cache of the last view found to hold a scene.
#pragma once
#include <optional>

#include "clench/render/view/frame.h"
#include "clench/render/view/scene_key.h"

namespace clench {

struct FramedScene {
  SceneKey key;
  double aspect;
  bool ortho;
  Eye eye;
};

}  // namespace clench
