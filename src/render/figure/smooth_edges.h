// Edges of a picture that was drawn with one sample a pixel, made smooth.
#pragma once
#include "clench/render/figure/picture.h"

namespace clench {

/// Mixes pixels at edges with those across, by where along a step of the edge they lie. Colours are
/// multiplied by alpha where there is alpha.
/// source  Lottes (2009), FXAA
void smooth_edges(Picture& picture);

}  // namespace clench
