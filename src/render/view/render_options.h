// How large and how smooth a picture is, and what it is drawn on.
#pragma once
#include "clench/base/progress.h"

namespace clench {

/// Paper: soft shadows, light from all around, smooth edges. Draft: one shadow, and a fraction of
/// the time.
enum class Quality { paper, draft };

/// A studio; or nothing but the shadow on the floor, on white or on nothing at all.
enum class Backdrop { studio, white, transparent };

struct RenderOptions {
  static constexpr int min_size = 16, max_size = 8192, max_draft_scale = 4;
  int width = 1280, height = 960;  ///< pixels, min_size..max_size
  /// a pixel: smoothness of edges and shadows against time, 1..256; drafts have one, with edges
  /// smoothed
  int samples = 8;
  /// factor by which a draft is drawn wider and higher before it is reduced, which smooths it:
  /// 1..max_draft_scale
  int draft_scale = 1;
  Quality quality = Quality::paper;
  Backdrop backdrop = Backdrop::studio;
  double outline = 0;  ///< width of lines around bodies and along their edges, 0..32 [pixels]
  /// height of capital letters [pixels], up to 200; 0: a part of the picture's
  double letters = 0;
  Progress progress = {};
};

/// throws  Error on a number out of range, by name
void check(const RenderOptions& options);

}  // namespace clench
