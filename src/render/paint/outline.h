// Lines around bodies and along their edges, found in what is seen first.
#pragma once
#include "clench/render/gl/gl_objects.h"
#include "clench/render/paint/shadows.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// Textures of what is seen: places, unit normals, and whether there is anything (alpha of the
/// third).
struct SeenTextures {
  unsigned places, facings, paints;
};

/// Lives inside the life of a GlContext; `eye` is in scene units.
class Outline {
 public:
  Outline(unsigned program, const Eye& eye, const RenderOptions& options);
  /// Over the framebuffer that is bound. `soft`: lines have soft sides, where there is one sample a
  /// pixel.
  void draw(const SeenTextures& seen, float cover, bool soft) const;

 private:
  unsigned program_;
  const Eye& eye_;
  const RenderOptions& options_;
  Cover cover_;
};

}  // namespace clench
