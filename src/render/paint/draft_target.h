// What drafts are drawn to, kept from picture to picture.
#pragma once
#include <optional>

#include "clench/render/gl/gl_objects.h"

namespace clench {

/// One sample a pixel, and where lines are asked for, what they are found in. Lives inside the life
/// of a GlContext.
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

/// A picture on the graphics card: colors multiplied by alpha. Lives inside the life of a
/// GlContext.
struct FrameTarget {
  FrameTarget(int width, int height);
  size_t bytes() const;

  int width, height;  ///< [pixels]
  gl::Object pixels, target;
};

}  // namespace clench
