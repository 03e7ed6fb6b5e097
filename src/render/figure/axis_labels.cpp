#include "clench/render/figure/axis_labels.h"

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/text.h"

namespace clench {

namespace {

constexpr float level_label = 110;  // labels stay level at this pitch or more [pixels]
constexpr float between = 4;        // gap between two labels [pixels]

// number of letters that all texts share at their beginning, or at their end
size_t common_letters(const std::vector<std::u32string>& texts, bool from_end) {
  const auto letter = [&](const std::u32string& text, size_t i) {
    return from_end ? text[text.size() - 1 - i] : text[i];
  };
  size_t count = texts[0].size();
  for (const std::u32string& text : texts) {
    size_t same = 0;
    while (same < std::min(count, text.size()) && letter(text, same) == letter(texts[0], same))
      ++same;
    count = same;
  }
  return count;
}

// replaces the prefix and the suffix that all texts share by an ellipsis: the rest distinguishes
// them
void drop_common(std::vector<std::string>& texts) {
  if (std::ranges::adjacent_find(texts, std::not_equal_to()) == texts.end()) return;
  std::vector<std::u32string> letters;
  for (const std::string& text : texts) letters.push_back(letters_of(text));
  for (const bool at_end : {false, true}) {
    const size_t common = common_letters(letters, at_end);
    if (common < 2) continue;
    for (std::u32string& text : letters)
      text.replace(at_end ? text.size() - common : 0, common, U"…");
  }
  std::ranges::transform(letters, texts.begin(), text_of);
}

}  // namespace

AxisLabels::AxisLabels(std::vector<std::string> texts, float pitch, float longest, float height,
                       const Font& font)
    : texts_(std::move(texts)), pitch_(pitch), height_(height) {
  const auto widest = [&] {
    float most = 0;
    for (const std::string& text : texts_) most = std::max(most, font.width(text, height));
    return most;
  };
  upright_ = widest() + between > pitch && pitch < level_label;
  const float length = upright_ ? longest : pitch - between;
  if (widest() > length) drop_common(texts_);
  for (std::string& text : texts_) text = font.shortened(text, height, length);
  room_ = upright_ ? widest() : height;
}

void AxisLabels::draw(Pen& pen, float top, const std::function<float(size_t)>& center,
                      const Drawing::Color& color) const {
  const float least = upright_ ? height_ + between : 0;
  const size_t every = floor_between(std::ceil(least / pitch_), size_t{1}, texts_.size());
  for (size_t i = 0; i < texts_.size(); i += every) {
    const float width = pen.font.width(texts_[i], height_), x = center(i);
    if (upright_)
      pen.text(texts_[i], {x + height_ / 2, top + width}, height_, color, true);
    else
      pen.text(texts_[i], {x - width / 2, top + height_}, height_, color);
  }
}

}  // namespace clench
