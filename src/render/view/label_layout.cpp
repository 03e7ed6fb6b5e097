#include "clench/render/view/label_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/render/figure/broken_lines.h"
#include "clench/render/view/frame.h"

namespace clench {

using Eigen::Vector2f;

namespace {

constexpr float label_part = 0.018f, caption_part = 0.022f;  // fractions of the picture's height
constexpr float min_letters = 9;                             // minimum height [pixels]
constexpr float min_picture = 120;  // in smaller pictures words would hide everything else [pixels]
// half width of an arrow, as a fraction of the picture's height
constexpr float arrow_air = 0.004f;
constexpr float air = 0.35f;  // margin around letters, as a fraction of their height
const Eigen::Vector3f caption_color(0.1f, 0.1f, 0.1f);

// where a box may move if its place is taken: 16 places on each of 8 rings about it
constexpr int rings = 8, ring_places = 16;
constexpr float ring_step = 0.5f;  // in heights of the box

PixelBox moved(const PixelBox& box, const Vector2f& by) { return {box.low + by, box.high + by}; }

// shifted into the picture; one that is larger keeps its lower corner in it
PixelBox kept_inside(const PixelBox& box, const Vector2f& picture) {
  const Vector2f over = (box.high - picture).cwiseMax(0.0f);
  const PixelBox left = moved(box, -over);
  return moved(left, (-left.low).cwiseMax(0.0f));
}

std::optional<PixelBox> find_room(const PixelBox& expected, const Vector2f& picture,
                                  std::span<const PixelBox> taken) {
  const float height = expected.high.y() - expected.low.y();
  for (int k = 0; k <= rings * ring_places; ++k) {
    const int ring = (k + ring_places - 1) / ring_places;
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / ring_places;
    const float distance = ring_step * height * static_cast<float>(ring);
    // wider than high: as far sideways as letters are wide would be too far
    const PixelBox tried = kept_inside(
        moved(expected, distance * Vector2f(2 * std::cos(turn), std::sin(turn))), picture);
    const auto hits = [&](const PixelBox& other) { return tried.overlaps(other); };
    if (std::none_of(taken.begin(), taken.end(), hits)) return tried;
  }
  return {};
}

// projects a point to pixels of the picture
std::optional<Vector2f> seen_at(const Eigen::Vector3d& p_W, const Eye& eye,
                                const Vector2f& picture) {
  const Eigen::Vector3d p = view_axes(eye).transpose() * (p_W - eye.eye);
  if (eye.ortho_height == 0 && !(p.z() < 0)) return {};
  const double pixels = eye.ortho_height > 0
                            ? picture.y() / eye.ortho_height
                            : 0.5 * picture.y() / std::tan(eye.field_of_view / 2) / -p.z();
  const Vector2f at(
      static_cast<float>(0.5 * picture.x() + eye.aside * picture.y() + pixels * p.x()),
      static_cast<float>(0.5 * picture.y() - pixels * p.y()));
  if ((at.array() < 0).any() || (at.array() > picture.array()).any()) return {};
  return at;
}

// boxes along an arrow, which labels avoid
void take_arrow(const DrawArrow& arrow, const Eye& eye, const Vector2f& picture,
                std::vector<PixelBox>& taken) {
  constexpr int pieces = 24;
  const Vector2f half = Vector2f::Constant(arrow_air * picture.y());
  for (int i = 0; i <= pieces; ++i) {
    const Eigen::Vector3d p_W = arrow.tail + (arrow.tip - arrow.tail) * i / pieces;
    if (const auto at = seen_at(p_W, eye, picture)) taken.push_back({*at - half, *at + half});
  }
}

void place_caption(const Scene& scene, const Vector2f& picture, const Font& font, float letters,
                   std::vector<PlacedText>& out) {
  const float height = letters > 0 ? letters : std::max(min_letters, caption_part * picture.y());
  const float room = picture.x() - 2 * height;
  std::vector<std::string> lines;
  for (const std::string& line : scene.caption)
    for (std::string& part : broken_lines(line, height, room, font))
      lines.push_back(std::move(part));
  Vector2f at(height, picture.y() - height);
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    const std::string text = font.shortened(*line, height, room);
    const float width = font.width(text, height);
    out.push_back(
        {{at - Vector2f(0, height), at + Vector2f(width, 0)}, text, caption_color, height});
    at.y() -= 1.8f * height;
  }
}

}  // namespace

std::vector<std::optional<PixelBox>> spread_boxes(std::span<const PixelBox> expected,
                                                  const Vector2f& picture,
                                                  std::vector<PixelBox> taken) {
  std::vector<std::optional<PixelBox>> places;
  for (const PixelBox& box : expected) {
    places.push_back(find_room(box, picture, taken));
    if (places.back()) taken.push_back(*places.back());
  }
  return places;
}

std::vector<PlacedText> place_texts(const Scene& scene, const Eye& eye, const Vector2f& picture,
                                    const Font& font, float letters) {
  std::vector<PlacedText> texts;
  if (picture.minCoeff() < min_picture) return texts;
  place_caption(scene, picture, font, letters, texts);
  std::vector<PixelBox> taken, expected;
  for (const PlacedText& text : texts) taken.push_back(text.box);
  for (const DrawArrow& arrow : scene.arrows) take_arrow(arrow, eye, picture, taken);

  const float height = letters > 0 ? letters : std::max(min_letters, label_part * picture.y());
  const Vector2f around(air * height, air * height);
  std::vector<PlacedText> labels;
  for (const DrawLabel& label : scene.labels) {
    const auto at = seen_at(label.p_W, eye, picture);
    if (!at) continue;
    const Vector2f half(font.width(label.text, height) / 2, height / 2);
    labels.push_back({{}, label.text, label.color, height});
    expected.push_back({*at - half - around, *at + half + around});
  }
  const auto places = spread_boxes(expected, picture, std::move(taken));
  for (size_t i = 0; i < labels.size(); ++i) {
    if (!places[i]) continue;
    labels[i].box = {places[i]->low + around, places[i]->high - around};
    texts.push_back(std::move(labels[i]));
  }
  return texts;
}

}  // namespace clench
