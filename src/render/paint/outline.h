// Lines around bodies and along their edges, found in the first visible surfaces.
#pragma once
#include "clench/render/gl/gl_objects.h"
#include "clench/render/paint/shadows.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// Textures of the visible surfaces: positions, unit normals, and coverage (alpha of the third).
struct SeenTextures {
  unsigned places, facings, paints;
};

/// Must not outlive its GlContext; `eye` is in scene units.
class Outline {
 public:
  Outline(unsigned program, const Eye& eye, const RenderOptions& options);
  /// Draws over the bound framebuffer. `soft`: lines have soft sides, used with one sample per
  /// pixel.
  void draw(const SeenTextures& seen, float cover, bool soft) const;

 private:
  unsigned program_;
  const Eye& eye_;
  const RenderOptions& options_;
  Cover cover_;
};

}  // namespace clench
