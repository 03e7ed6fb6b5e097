// A scene as a picture, by OpenGL 3.3 through EGL without display: the same bytes for the same scene.
#pragma once
#include "render/picture.h"
#include "scene/scene.h"

namespace clench {

struct RenderOptions {
  int width = 1280, height = 960;   ///< pixels, 16..8192
};

/// throws Error that says what to install when there is no EGL or no OpenGL 3.3, and on a size out of range
Picture render(const Scene& scene, const RenderOptions& options = {});

/// The view that `render` uses when the scene names none: everything in the frame, from above and the side.
Eye frame_all(const Scene& scene, double aspect);

}  // namespace clench
