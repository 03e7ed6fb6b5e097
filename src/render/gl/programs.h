// The programs of the graphics card, compiled once for all pictures of a context.
#pragma once
#include <map>

#include "clench/render/gl/gl_objects.h"

namespace clench {

inline constexpr int lamps_per_sample = 4;  ///< that `shade` takes
inline constexpr int lights_at_once = 12;   ///< that `gather` takes

/// Lives inside the life of a GlContext.
struct Programs {
  /// throws Error with the driver's words
  Programs();
  gl::Object first, shade, mark, through, outline, add, develop;  ///< what is seen
  gl::Object shadow, gather, smooth;                              ///< light
  gl::Object draft, draft_glass, draft_marks, draft_floor, draft_behind, draft_outline,
      draft_shadow, edges;

  /// Of `first`, `through`, `draft` and `draft_glass`, the same with colors from an image; 0 of
  /// others. Compiled when first asked for.
  unsigned on_image(unsigned program) const;

 private:
  mutable std::map<unsigned, gl::Object> on_image_;
};

}  // namespace clench
