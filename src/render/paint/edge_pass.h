// Anti-aliasing of the edges of a draft on the graphics card.
#pragma once
#include <array>
#include <vector>

#include "clench/render/paint/shadows.h"
#include "clench/render/view/pixel_rect.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Destination of a picture: a framebuffer, the picture's lower left corner in it [pixels], and
/// which of red, green and blue are written; parts of the picture that are not needed.
struct Destination {
  unsigned framebuffer = 0;
  int x = 0, y = 0;
  std::array<bool, 3> channels = {true, true, true};
  std::vector<PixelRect> covered = {};
};

/// Pixels farther apart than this do not influence each other.
constexpr int smoothing_reach = 14;

/// Mixes each pixel at a stepped edge with the pixel across the edge: the nearer to the step, the
/// more. `program` is Programs::edges; `colors` holds the picture, with colors premultiplied by alpha.
/// source  Lottes (2009), FXAA
void smooth_to(unsigned program, const Cover& cover, unsigned colors, const RenderOptions& options,
               const Destination& destination);

}  // namespace clench
