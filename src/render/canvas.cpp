#include "render/canvas.h"

#include <algorithm>
#include <cmath>

#include "base/convert.h"
#include "render/lettering.h"

namespace clench {

using Eigen::Vector2f;

namespace {

// the pixels of a row or column that an interval reaches, cut off at the picture's edges
struct PixelRange {
  int first, last;
};
PixelRange pixels_of(float low, float high, int count) {
  return {floor_between(low, 0, count), floor_between(std::ceil(high), 0, count) - 1};
}

// part of the pixel [i, i+1] that [low, high] covers
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
  for (int k = 0; k < 3; ++k) {
    const float mixed = (1 - part) * pixel[k] + part * 255 * color[k];
    pixel[k] = static_cast<uint8_t>(floor_between(mixed + 0.5, 0, 255));
  }
}

void Canvas::fill(const Color& color) {
  for (int y = 0; y < picture_.height; ++y)
    for (int x = 0; x < picture_.width; ++x) blend(x, y, 1, color);
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
  const PixelRange xs = pixels_of(low.x() - reach, high.x() + reach, picture_.width);
  const PixelRange ys = pixels_of(low.y() - reach, high.y() + reach, picture_.height);
  for (int y = ys.first; y <= ys.last; ++y)
    for (int x = xs.first; x <= xs.last; ++x) {
      const Vector2f centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float inside = width / 2 + 0.5f - distance_to_segment(centre, from, to);
      if (inside > 0) blend(x, y, std::min(inside, 1.0f), color);
    }
}

float Canvas::text_width(std::string_view words, float height) {
  const float scale = height / (letter_top - letter_baseline);
  return static_cast<float>(letters_of(words).size()) * letter_advance * scale;
}

std::string Canvas::shortened(std::string_view words, float height, float width) {
  if (text_width(words, height) <= width) return std::string(words);
  const std::u32string letters = letters_of(words);
  const float letter = text_width("x", height);
  // one of those that fit is the ellipsis
  const int kept = floor_int(width / letter) - 1;
  if (kept < 0) return "";
  const auto back = static_cast<size_t>(kept / 2), front = static_cast<size_t>(kept) - back;
  return text_of(letters.substr(0, front) + U"…" + letters.substr(letters.size() - back));
}

void Canvas::text(std::string_view words, const Vector2f& at, float height, const Color& color,
                  const Vector2f& along) {
  const float scale = height / (letter_top - letter_baseline);
  const float width = std::max(1.0f, 0.8f * scale);
  const Vector2f down(-along.y(), along.x());
  Vector2f origin = at;
  const auto place = [&](const Vector2f& p) {
    return Vector2f(origin + scale * (p.x() * along + (letter_baseline - p.y()) * down));
  };
  for (const char32_t letter : letters_of(words)) {
    for (const auto& stroke : strokes_of(letter)) {
      if (stroke.size() == 1) line(place(stroke[0]), place(stroke[0]), 1.5f * width, color);
      for (size_t i = 1; i < stroke.size(); ++i)
        line(place(stroke[i - 1]), place(stroke[i]), width, color);
    }
    origin += letter_advance * scale * along;
  }
}

void Canvas::bright_text(std::string_view words, const Vector2f& at, float height,
                         const Color& color) {
  for (const float dx : {-1.0f, 1.0f})
    for (const float dy : {-1.0f, 1.0f}) text(words, at + Vector2f(dx, dy), height, Color(1, 1, 1));
  text(words, at, height, color);
}

}  // namespace clench
