// Reduction of pictures with several samples per pixel, and of colors premultiplied by alpha.
#pragma once
#include "clench/render/figure/picture.h"

namespace clench {

/// Root mean square of blocks of scale x scale pixels, weighted by alpha; width and height are
/// multiples of the scale.
Picture reduced(const Picture& large, int scale);

/// Converts premultiplied colors to straight ones.
void divide_by_alpha(Picture& picture);

}  // namespace clench
