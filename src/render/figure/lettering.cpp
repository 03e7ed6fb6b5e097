#include "clench/render/figure/lettering.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_ADVANCES_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/text.h"

namespace clench {

using Eigen::Vector2f;

static constexpr float max_letter_height = 1000;  // [pixels]
// maximum coordinate, as FreeType counts in 64ths [pixels]
static constexpr float max_letter_place = 1e5f;

struct Font::Face {
  std::string bytes;  // contents of the file
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  float capital = 0;  // height of capital letters [font units]

  explicit Face(const std::string& path) : bytes(read_bytes(path)) {
    if (FT_Init_FreeType(&library) != 0)
      fail(ErrorKind::file, "{}: FreeType failed to initialize", path);
    const auto* data = reinterpret_cast<const FT_Byte*>(bytes.data());
    FT_New_Memory_Face(library, data, static_cast<FT_Long>(bytes.size()), 0, &face);
    if (face && FT_IS_SCALABLE(face) && index('H') != 0 && load(index('H')))
      capital = static_cast<float>(face->glyph->metrics.horiBearingY);
    if (!(capital > 0)) {
      FT_Done_FreeType(library);
      fail(ErrorKind::file, "{}: expected an outline font with Latin letters", path);
    }
  }
  // this frees its faces, too
  ~Face() { FT_Done_FreeType(library); }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;

  // 0 is the box for missing characters
  FT_UInt index(char32_t letter) const { return FT_Get_Char_Index(face, letter); }
  // in font units, which are independent of hinting
  bool load(FT_UInt glyph) const { return FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) == 0; }
  // in font units, so that sums are exact
  int64_t advance(char32_t letter) const {
    FT_Fixed units = 0;
    FT_Get_Advance(face, index(letter), FT_LOAD_NO_SCALE, &units);
    return units;
  }
  // converts font units to pixels
  float length(int64_t units, float height) const {
    return static_cast<float>(units) * height / capital;
  }
};

Font::Font() : Font(CLENCH_FONT) {}

Font::Font(const std::string& path) {
  try {
    face_ = std::make_unique<Face>(path);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::file) throw;
    fault_ = fmt::format("pictures have no letters: {}", error.what());
  }
}

Font::~Font() = default;

float Font::width(std::string_view text, float height) const {
  if (!face_) return 0;
  int64_t units = 0;
  for (const char32_t letter : letters_of(text)) units += face_->advance(letter);
  return face_->length(units, height);
}

std::string Font::shortened(std::string_view text, float height, float width) const {
  if (this->width(text, height) <= width) return std::string(text);
  const std::u32string letters = letters_of(text);
  const auto fits = [&](int64_t units) { return face_->length(units, height) <= width; };
  int64_t units = face_->advance(U'…');
  if (!fits(units)) return "";
  // adds a letter at the front, then one at the back, while they fit
  size_t front = 0, back = 0;
  while (front + back < letters.size()) {
    const bool at_front = front <= back;
    units += face_->advance(at_front ? letters[front] : letters[letters.size() - 1 - back]);
    if (!fits(units)) break;
    ++(at_front ? front : back);
  }
  return text_of(letters.substr(0, front) + U"…" + letters.substr(letters.size() - back));
}

std::set<char32_t> Font::missing(std::string_view text) const {
  std::set<char32_t> out;
  if (!face_) return out;
  for (const char32_t letter : letters_of(text))
    if (face_->index(letter) == 0) out.insert(letter);
  return out;
}

// one row of a letter, called by FreeType
static void cover_spans(int y, int count, const FT_Span* spans, void* user) {
  const auto& cover = *static_cast<const Font::Cover*>(user);
  for (const FT_Span* span = spans; span != spans + count; ++span)
    for (int x = span->x; span->coverage > 0 && x < span->x + span->len; ++x)
      cover(x, y, static_cast<float>(span->coverage) / 255);
}

void Font::cover(const TextLine& line, const Eigen::Vector2i& size, const Cover& cover) const {
  if (!face_ || !(line.height > 0 && line.height <= max_letter_height)) return;
  const float scale = line.height / face_->capital;
  // converts font units, y up, to 64ths of a pixel, y down
  const auto fixed = [&](float part) { return std::lround(part * scale * 64 * 65536); };
  const Vector2f& along = line.along;
  const FT_Matrix turn{fixed(along.x()), fixed(along.y()), fixed(along.y()), fixed(-along.x())};

  FT_Raster_Params drawing{};
  drawing.flags = FT_RASTER_FLAG_AA | FT_RASTER_FLAG_DIRECT | FT_RASTER_FLAG_CLIP;
  drawing.gray_spans = cover_spans;
  drawing.user = const_cast<Cover*>(&cover);
  drawing.clip_box = {0, 0, size.x(), size.y()};
  int64_t units = 0;
  for (const char32_t letter : letters_of(line.text)) {
    const Vector2f at = line.at + face_->length(units, line.height) * along;
    units += face_->advance(letter);
    if (!(at.cwiseAbs().maxCoeff() < max_letter_place) || !face_->load(face_->index(letter)))
      continue;
    FT_Outline& outline = face_->face->glyph->outline;
    FT_Outline_Transform(&outline, &turn);
    FT_Outline_Translate(&outline, std::lround(64 * at.x()), std::lround(64 * at.y()));
    FT_Outline_Render(face_->library, &outline, &drawing);
  }
}

}  // namespace clench
