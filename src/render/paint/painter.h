// Draws a scene tile by tile and pass by pass.
#pragma once
#include "clench/render/figure/picture.h"
#include "clench/render/gl/programs.h"
#include "clench/render/paint/paper_scene.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Must not outlive its GlContext; `eye` is in scene units.
/// throws  Stopped; Error if the driver fails
/// source  Haeberli & Akeley (1990), The accumulation buffer: soft shadows, smooth edges
Picture paint(const Programs& programs, PaperScene& scene, const Eye& eye,
              const RenderOptions& options);

}  // namespace clench
