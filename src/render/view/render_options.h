// Size, quality and backdrop of a picture.
#pragma once
#include "clench/base/progress.h"

namespace clench {

/// Paper: soft shadows, ambient light, smooth edges. Draft: one shadow, in a fraction of the time.
enum class Quality { paper, draft };

/// A studio; or only the shadow on the floor, on white or on a transparent backdrop.
enum class Backdrop { studio, white, transparent };

/// How bodies are drawn: their faces, the edges of their triangles, or their vertices.
enum class DrawStyle { faces, wireframe, points };

struct RenderOptions {
  static constexpr int min_size = 16, max_size = 8192, max_draft_scale = 4;
  int width = 1280, height = 960;  ///< pixels, min_size..max_size
  /// per pixel: trades time for smooth edges and shadows, 1..256; drafts have one, with edges
  /// smoothed
  int samples = 8;
  /// factor by which the width and height of a draft are multiplied before it is reduced, which
  /// smooths it: 1..max_draft_scale
  int draft_scale = 1;
  Quality quality = Quality::paper;
  Backdrop backdrop = Backdrop::studio;
  DrawStyle style = DrawStyle::faces;  ///< others of drafts only
  double outline = 0;  ///< width of lines around bodies and along their edges, 0..32 [pixels]
  /// height of capital letters [pixels], up to 200; 0: a fraction of the picture's
  double letters = 0;
  Progress progress = {};
};

/// throws  Error naming the number out of range
void check(const RenderOptions& options);

}  // namespace clench
