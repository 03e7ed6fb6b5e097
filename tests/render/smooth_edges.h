// Edges smoothed pixel by pixel: the reference for the graphics card.
#pragma once
#include <algorithm>
#include <cmath>

#include "clench/render/figure/picture.h"

namespace clench::test {

inline constexpr int reach_along = 12;   // maximal length of a step that is followed [pixels]
inline constexpr int min_contrast = 12;  // minimal contrast that is smoothed, of 255
inline constexpr float part_contrast = 0.1f,
                       max_spot = 0.6f;  // relative to the brightest; for a single pixel

struct Brightness {
  int width, height;
  std::vector<uint8_t> values;
  int at(int x, int y) const { return values[static_cast<size_t>(y) * width + x]; }
};

// as on a white background
inline Brightness brightness_of(const Picture& p) {
  Brightness out{p.width, p.height, {}};
  out.values.resize(static_cast<size_t>(p.width) * p.height);
  for (size_t i = 0; i < out.values.size(); ++i) {
    const uint8_t* c = &p.pixels[3 * i];
    const int white = p.alpha.empty() ? 0 : 255 - p.alpha[i];
    out.values[i] = static_cast<uint8_t>(std::min(255, (2 * c[0] + 5 * c[1] + c[2]) / 8 + white));
  }
  return out;
}

// fraction to mix in from a neighbor across the edge, and its offset
struct Mix {
  float part = 0;
  int dx = 0, dy = 0;
};

inline Mix mix_at(const Brightness& b, int x, int y) {
  const int m = b.at(x, y), n = b.at(x, y - 1), s = b.at(x, y + 1), e = b.at(x + 1, y),
            w = b.at(x - 1, y);
  const int high = std::max({m, n, s, e, w}), low = std::min({m, n, s, e, w}), range = high - low;
  if (range < min_contrast || static_cast<float>(range) < part_contrast * static_cast<float>(high))
    return {};
  const int ne = b.at(x + 1, y - 1), nw = b.at(x - 1, y - 1), se = b.at(x + 1, y + 1),
            sw = b.at(x - 1, y + 1);
  const bool level =
      2 * std::abs(n + s - 2 * m) + std::abs(ne + se - 2 * e) + std::abs(nw + sw - 2 * w) >=
      2 * std::abs(e + w - 2 * m) + std::abs(ne + nw - 2 * n) + std::abs(se + sw - 2 * s);

  // the edge is on the steeper side
  const int before = level ? n : w, after = level ? s : e;
  const int side = std::abs(before - m) >= std::abs(after - m) ? -1 : 1;
  Mix mix{0, level ? 0 : side, level ? side : 0};
  const int across = side < 0 ? before : after;
  const float steep = 0.25f * static_cast<float>(std::abs(across - m));
  const float middle = 0.5f * static_cast<float>(m + across);
  float nearest = 0, all = 0, end = 0;
  for (const int way : {-1, 1}) {
    float off = 0;
    int steps = 1;
    for (; steps < reach_along; ++steps) {
      const int px = x + (level ? way * steps : 0), py = y + (level ? 0 : way * steps);
      if (px < 1 || py < 1 || px >= b.width - 1 || py >= b.height - 1) {
        steps = reach_along;  // its end is unknown
        break;
      }
      off = 0.5f * static_cast<float>(b.at(px, py) + b.at(px + mix.dx, py + mix.dy)) - middle;
      if (std::abs(off) >= steep) break;
    }
    const auto distance = static_cast<float>(steps);
    if (way < 0 || distance < nearest) nearest = distance, end = off;
    all += distance;
  }
  // only if the edge crosses the pixel's side of the step
  if (std::abs(end) >= steep && (end < 0) != (static_cast<float>(m) - middle < 0))
    mix.part = 0.5f - nearest / all;
  const float around = static_cast<float>(2 * (n + s + e + w) + ne + nw + se + sw) / 12;
  // 1/3 next to a straight edge, which must not be smoothed
  const float unlike = std::abs(around - static_cast<float>(m)) / static_cast<float>(range);
  const float alone = std::clamp((unlike - 0.35f) / 0.65f, 0.0f, 1.0f);
  const float spot = alone * alone * (3 - 2 * alone);
  mix.part = std::max(mix.part, max_spot * spot * spot);
  return mix;
}

// contrasts between each pixel of a row and its four neighbors. Only bytes, so that compilers
// vectorize it: few pixels need more work
inline void find_contrasts(const Brightness& b, int y, std::vector<uint8_t>& contrasts) {
  const uint8_t* row = &b.values[static_cast<size_t>(y) * b.width];
  const uint8_t *above = row - b.width, *below = row + b.width;
  uint8_t* out = contrasts.data();
  for (int x = 1; x + 1 < b.width; ++x) {
    const uint8_t high =
        std::max(std::max(std::max(above[x], below[x]), std::max(row[x - 1], row[x + 1])), row[x]);
    const uint8_t low =
        std::min(std::min(std::min(above[x], below[x]), std::min(row[x - 1], row[x + 1])), row[x]);
    out[x] = static_cast<uint8_t>(high - low);
  }
}

/// Mixes pixels at edges with those across the edge, according to their position along a step of
/// the edge. Colors are premultiplied if there is alpha.
/// source  Lottes (2009), FXAA
inline void smooth_edges(Picture& picture) {
  const Brightness b = brightness_of(picture);
  const Picture from = picture;
  const auto mixed = [](const std::vector<uint8_t>& values, size_t here, size_t across,
                        float part) {
    const float sum = (1 - part) * values[here] + part * values[across];
    return static_cast<uint8_t>(sum + 0.5f);
  };
  std::vector<uint8_t> contrasts(picture.width);
  for (int y = 1; y + 1 < picture.height; ++y) {
    find_contrasts(b, y, contrasts);
    for (int x = 1; x + 1 < picture.width; ++x) {
      if (contrasts[x] < min_contrast) continue;
      const Mix mix = mix_at(b, x, y);
      if (!(mix.part > 0)) continue;
      const size_t here = static_cast<size_t>(y) * picture.width + x,
                   across = static_cast<size_t>(y + mix.dy) * picture.width + x + mix.dx;
      for (int k = 0; k < 3; ++k)
        picture.pixels[3 * here + k] = mixed(from.pixels, 3 * here + k, 3 * across + k, mix.part);
      if (!from.alpha.empty()) picture.alpha[here] = mixed(from.alpha, here, across, mix.part);
    }
  }
}

}  // namespace clench::test
