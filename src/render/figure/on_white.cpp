#include "clench/render/figure/picture.h"

namespace clench {

Picture on_white(const Picture& picture) {
  Picture out{picture.width, picture.height, picture.pixels};
  for (size_t i = 0; i < picture.alpha.size(); ++i)
    for (size_t at = 3 * i; at < 3 * i + 3; ++at) {
      const int a = picture.alpha[i];
      out.pixels[at] = static_cast<uint8_t>((a * out.pixels[at] + (255 - a) * 255 + 127) / 255);
    }
  return out;
}

}  // namespace clench
