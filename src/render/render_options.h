// How large and how smooth a picture is.
#pragma once
#include "clench/base/progress.h"

namespace clench {

struct RenderOptions {
  int width = 1280, height = 960;  ///< pixels, 16..8192
  int samples = 8;  ///< a pixel: smoothness of edges and shadows against time, 1..256
  Progress progress = {};
};

}  // namespace clench
