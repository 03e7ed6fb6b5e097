// Shader programs, compiled once for all pictures of a context.
#pragma once
#include <map>

#include "clench/render/gl/gl_objects.h"

namespace clench {

inline constexpr int lamps_per_sample = 4;  ///< maximum that `shade` takes
inline constexpr int lights_at_once = 12;   ///< maximum that `gather` takes

/// Must not outlive its GlContext.
struct Programs {
  /// throws Error with the driver's message
  Programs();
  gl::Object first, shade, mark, through, outline, add, develop;  ///< passes for visible surfaces
  gl::Object shadow, gather, smooth;                              ///< passes for light
  gl::Object draft, draft_glass, draft_marks, draft_floor, draft_behind, draft_outline,
      draft_shadow, edges;

  /// The textured variant of `first`, `through`, `draft` or `draft_glass`; 0 for other programs.
  /// Compiled at the first call.
  unsigned on_image(unsigned program) const;

 private:
  mutable std::map<unsigned, gl::Object> on_image_;
};

}  // namespace clench
