#include "clench/render/figure/canvas.h"

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"

namespace clench {

using Eigen::Vector2f;

namespace {

// the pixels of a row or column that an interval overlaps, clipped to the picture
struct PixelRange {
  int first, last;
};
PixelRange pixels_of(float low, float high, int count) {
  return {floor_between(low, 0, count), floor_between(std::ceil(high), 0, count) - 1};
}

// fraction of the pixel [i, i+1] that [low, high] covers
float covered(int i, float low, float high) {
  const float from = static_cast<float>(i);
  return std::clamp(std::min(high, from + 1) - std::max(low, from), 0.0f, 1.0f);
}

float distance_to_segment(const Vector2f& p, const Vector2f& a, const Vector2f& b) {
  const Vector2f along = b - a;
  const float length2 = along.squaredNorm();
  const float t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0f, 1.0f) : 0;
  return (a + t * along - p).norm();
}

}  // namespace

Picture blank_picture(int width, int height) {
  return {width, height, std::vector<uint8_t>(3 * static_cast<size_t>(width) * height, 255)};
}

void Canvas::blend(int x, int y, float part, const Color& color) {
  uint8_t* pixel = &picture_.pixels[3 * (static_cast<size_t>(y) * picture_.width + x)];
  // on a transparent picture, each layer is weighted by its coverage
  float keep = 1 - part;
  if (!picture_.alpha.empty()) {
    uint8_t& alpha = picture_.alpha[static_cast<size_t>(y) * picture_.width + x];
    const float under = (1 - part) * static_cast<float>(alpha) / 255, all = part + under;
    if (!(all > 0)) return;
    keep = under / all, part = part / all;
    alpha = static_cast<uint8_t>(floor_between(255 * all + 0.5f, 0, 255));
  }
  for (int k = 0; k < 3; ++k) {
    const float mixed = keep * pixel[k] + part * 255 * color[k];
    pixel[k] = static_cast<uint8_t>(floor_between(mixed + 0.5, 0, 255));
  }
}

void Canvas::rectangle(const Vector2f& low, const Vector2f& high, const Color& color) {
  const PixelRange xs = pixels_of(low.x(), high.x(), picture_.width);
  const PixelRange ys = pixels_of(low.y(), high.y(), picture_.height);
  for (int y = ys.first; y <= ys.last; ++y)
    for (int x = xs.first; x <= xs.last; ++x)
      blend(x, y, covered(x, low.x(), high.x()) * covered(y, low.y(), high.y()), color);
}

void Canvas::line(const Vector2f& from, const Vector2f& to, float width, const Color& color) {
  const float reach = width / 2 + 1;
  const Vector2f low = from.cwiseMin(to), high = from.cwiseMax(to);
  const PixelRange ys = pixels_of(low.y() - reach, high.y() + reach, picture_.height);
  const Vector2f way = to - from;
  for (int y = ys.first; y <= ys.last; ++y) {
    // the part of the line that can touch this row, as fractions of its length
    const float row = static_cast<float>(y) + 0.5f;
    float begin = 0, end = 1;
    if (way.y() != 0) {
      const float a = (row - reach - from.y()) / way.y(), b = (row + reach - from.y()) / way.y();
      begin = std::clamp(std::min(a, b), 0.0f, 1.0f);
      end = std::clamp(std::max(a, b), 0.0f, 1.0f);
    }
    const float x0 = from.x() + begin * way.x(), x1 = from.x() + end * way.x();
    const PixelRange xs =
        pixels_of(std::min(x0, x1) - reach, std::max(x0, x1) + reach, picture_.width);
    for (int x = xs.first; x <= xs.last; ++x) {
      const Vector2f center(static_cast<float>(x) + 0.5f, row);
      const float inside = width / 2 + 0.5f - distance_to_segment(center, from, to);
      if (inside > 0) blend(x, y, std::min(inside, 1.0f), color);
    }
  }
}

void Canvas::text(const TextLine& line, const Color& color) {
  font_.cover(line, {picture_.width, picture_.height},
              [&](int x, int y, float part) { blend(x, y, part, color); });
}

void Canvas::bright_text(const TextLine& line, const Color& color) {
  TextLine moved = line;
  for (const float dx : {-1.0f, 1.0f})
    for (const float dy : {-1.0f, 1.0f}) {
      moved.at = line.at + Vector2f(dx, dy);
      text(moved, Color(1, 1, 1));
    }
  text(line, color);
}

}  // namespace clench
