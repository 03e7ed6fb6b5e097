#include "clench/render/figure/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/render/figure/broken_lines.h"
#include "clench/render/figure/canvas.h"

namespace clench {

static constexpr int max_side = 16384;                          // [pixels]
static constexpr float caption_height = 10, caption_room = 22;  // [pixels]
static constexpr int note_step = 18;                            // [pixels]
static const Eigen::Vector3f caption_ink(0.13f, 0.16f, 0.20f);

static void check_sheet(const std::vector<const Picture*>& pictures, const SheetOptions& options) {
  if (pictures.empty()) fail("sheet: expected at least one picture, got none");
  if (!options.captions.empty() && options.captions.size() != pictures.size())
    fail("sheet: expected {} captions, one per picture, got {}", pictures.size(),
         options.captions.size());
  if (options.columns < 0 || options.columns > max_side)
    fail("sheet: expected 1 to {} columns, got {}", max_side, options.columns);
  if (options.gap < 0 || options.gap > 1000)
    fail("sheet: expected a gap of 0 to 1000 pixels, got {}", options.gap);
}

static void copy(const Picture& from, Picture& to, int left, int top) {
  for (int y = 0; y < from.height; ++y) {
    const auto row = from.pixels.begin() + std::ptrdiff_t{3} * from.width * y;
    std::copy(row, row + std::ptrdiff_t{3} * from.width,
              to.pixels.begin() + 3 * (std::ptrdiff_t{to.width} * (top + y) + left));
  }
}

static std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  size_t from = 0;
  for (size_t end; (end = text.find('\n', from)) != text.npos; from = end + 1)
    lines.push_back(text.substr(from, end - from));
  lines.push_back(text.substr(from));
  return lines;
}

// height of the caption below a picture [pixels]
static int caption_space(const SheetOptions& options) {
  if (options.captions.empty()) return 0;
  size_t most = 1;
  for (const std::string& caption : options.captions)
    most = std::max(most, lines_of(caption).size());
  return floor_int(caption_room) + note_step * (floor_int(static_cast<double>(most)) - 1);
}

// writes each line centered in its cell, from the top
static void write_caption(const std::string& caption, float left, float top, float width,
                          const Font& font, Canvas& canvas) {
  float y = top + 6 + caption_height;
  for (const std::string& whole : lines_of(caption)) {
    const std::string line = font.shortened(whole, caption_height, width);
    const float x = left + (width - font.width(line, caption_height)) / 2;
    canvas.text({line, {x, y}, caption_height}, caption_ink);
    y += note_step;
  }
}

static std::vector<std::string> note_lines(const SheetOptions& options, double width,
                                           const Font& font) {
  std::vector<std::string> lines;
  const auto room = static_cast<float>(std::max(width - 2.0 * options.gap, 1.0));
  for (const std::string& note : options.notes)
    for (const std::string& line : broken_lines(note, caption_height, room, font))
      lines.push_back(font.shortened(line, caption_height, room));
  return lines;
}

static void write_notes(const std::vector<std::string>& lines, double top, int left,
                        Canvas& canvas) {
  auto y = static_cast<float>(top) + caption_height + 2;
  for (const std::string& line : lines) {
    canvas.text({line, {static_cast<float>(left), y}, caption_height}, caption_ink);
    y += note_step;
  }
}

Picture contact_sheet(const std::vector<const Picture*>& pictures, const SheetOptions& options,
                      const Font& font) {
  check_sheet(pictures, options);
  const int count = static_cast<int>(pictures.size());
  int cell_width = 0, cell_height = 0;
  for (const Picture* picture : pictures) {
    cell_width = std::max(cell_width, picture->width);
    cell_height = std::max(cell_height, picture->height);
  }
  const int below = caption_space(options);
  const double shape = static_cast<double>(cell_height + below) / std::max(cell_width, 1);
  const int columns = options.columns > 0
                          ? std::min(options.columns, count)
                          : floor_between(std::round(std::sqrt(count * shape)), 1, count);
  const int rows = (count + columns - 1) / columns;
  const double width = columns * (cell_width + double(options.gap)) + options.gap,
               top = rows * (cell_height + below + double(options.gap)) + options.gap;
  const std::vector<std::string> notes = note_lines(options, width, font);
  const double height =
      top + (notes.empty() ? 0 : note_step * static_cast<double>(notes.size()) + options.gap);
  if (width > max_side || height > max_side)
    fail(ErrorKind::limit, "sheet: expected at most {} pixels per side, got {} x {}", max_side,
         width, height);

  Picture sheet = blank_picture(floor_int(width), floor_int(height));
  Canvas canvas(sheet, font);
  for (int i = 0; i < count; ++i) {
    const Picture& picture = *pictures[i];
    const int left = options.gap + i % columns * (cell_width + options.gap);
    const int upper = options.gap + i / columns * (cell_height + below + options.gap);
    copy(on_white(picture), sheet, left + (cell_width - picture.width) / 2,
         upper + (cell_height - picture.height) / 2);
    if (options.captions.empty()) continue;
    write_caption(options.captions[i], static_cast<float>(left),
                  static_cast<float>(upper + cell_height), static_cast<float>(cell_width), font,
                  canvas);
  }
  write_notes(notes, top, options.gap, canvas);
  return sheet;
}

}  // namespace clench
