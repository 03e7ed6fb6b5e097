// Pictures with several samples a pixel, and colors that were multiplied by alpha.
#pragma once
#include "clench/render/figure/picture.h"

namespace clench {

/// The mean of squares of scale x scale pixels, weighted by how much they cover; width and height
/// are multiples of it.
Picture reduced(const Picture& large, int scale);

/// Colors that were multiplied by alpha become those of what covers.
void divide_by_alpha(Picture& picture);

}  // namespace clench
