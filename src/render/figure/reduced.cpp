#include "clench/render/figure/reduced.h"

#include <algorithm>

namespace clench {

Picture reduced(const Picture& large, int scale) {
  Picture out{large.width / scale, large.height / scale, {}};
  const size_t count = static_cast<size_t>(out.width) * out.height;
  out.pixels.resize(3 * count);
  if (!large.alpha.empty()) out.alpha.resize(count);
  const int squares = scale * scale;
  for (size_t i = 0; i < count; ++i) {
    const size_t x = i % out.width * scale, y = i / out.width * scale;
    int sums[3] = {}, cover = 0;
    for (int k = 0; k < squares; ++k) {
      const size_t at = (y + k / scale) * large.width + x + k % scale;
      const int weight = large.alpha.empty() ? 255 : large.alpha[at];
      cover += weight;
      for (int c = 0; c < 3; ++c) sums[c] += weight * large.pixels[3 * at + c];
    }
    for (int c = 0; c < 3 && cover > 0; ++c)
      out.pixels[3 * i + c] = static_cast<uint8_t>((sums[c] + cover / 2) / cover);
    if (!out.alpha.empty()) out.alpha[i] = static_cast<uint8_t>((cover + squares / 2) / squares);
  }
  return out;
}

void divide_by_alpha(Picture& picture) {
  for (size_t i = 0; i < picture.alpha.size(); ++i)
    for (size_t at = 3 * i; picture.alpha[i] > 0 && at < 3 * i + 3; ++at) {
      const int alpha = picture.alpha[i];
      picture.pixels[at] =
          static_cast<uint8_t>(std::min(255, (picture.pixels[at] * 255 + alpha / 2) / alpha));
    }
}

}  // namespace clench
