// Pictures one after the other, as an animated GIF.
#pragma once
#include <span>
#include <string>

#include "clench/render/figure/picture.h"

namespace clench {

/// All frames share up to 256 colors, and begin anew after the last.
/// delays   of each frame, in hundredths of a second
/// source   Heckbert (1982), Color image quantization for frame buffer display: median cut
/// throws   Error for no frames, sizes that differ, or more than 65535 pixels in a row
std::string gif_bytes(std::span<const Picture> frames, std::span<const int> delays);

}  // namespace clench
