// Render targets of drafts, kept for successive pictures.
#pragma once
#include <optional>

#include "clench/render/gl/gl_objects.h"

namespace clench {

/// One sample per pixel, and if lines are requested, the textures that they are found in. Must not
/// outlive its GlContext.
struct DraftTarget {
  struct Lines {
    Lines(int width, int height);
    gl::Object places, facings, there, depths, target;
  };

  DraftTarget(int width, int height, bool with_lines);
  bool fits(int wide, int high, bool with_lines) const {
    return wide == width && high == height && with_lines == lines.has_value();
  }
  size_t bytes() const;

  int width, height;  ///< [pixels]
  gl::Object colors, depths, target;
  std::optional<Lines> lines;
};

/// A picture on the graphics card, with colors premultiplied by alpha. Must not outlive its
/// GlContext.
struct FrameTarget {
  FrameTarget(int width, int height);
  size_t bytes() const;

  int width, height;  ///< [pixels]
  gl::Object pixels, target;
};

}  // namespace clench
