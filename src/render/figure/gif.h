// Sequences of pictures as an animated GIF.
#pragma once
#include <span>
#include <string>

#include "clench/render/figure/picture.h"

namespace clench {

/// All frames share up to 256 colors, and the animation repeats forever.
/// delays   of each frame, in hundredths of a second
/// source   Heckbert (1982), Color image quantization for frame buffer display: median cut
/// throws   Error if there are no frames, if sizes differ, or if a side exceeds 65535 pixels
std::string gif_bytes(std::span<const Picture> frames, std::span<const int> delays);

}  // namespace clench
