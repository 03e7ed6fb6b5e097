#include "clench/render/figure/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/base/printable.h"
#include "clench/base/text.h"
#include "clench/render/figure/canvas.h"

namespace clench {

namespace {

constexpr float capital_height = 0.729f;  // of DejaVu Sans, per font size
constexpr float rim_width = 3;            // half of it lies outside a letter's outline [pixels]

struct ItemPainter {
  Canvas& canvas;

  void operator()(const Drawing::Line& line) const {
    if (line.points.size() == 1)
      canvas.line(line.points[0], line.points[0], line.width, line.color);
    for (size_t i = 1; i < line.points.size(); ++i)
      canvas.line(line.points[i - 1], line.points[i], line.width, line.color);
  }
  void operator()(const Drawing::Area& area) const {
    canvas.rectangle(area.low, area.high, area.color);
  }
  void operator()(const Drawing::Text& text) const {
    TextLine line{text.text, text.at, text.height};
    if (text.upright) line.along = -Eigen::Vector2f::UnitY();
    text.rim ? canvas.bright_text(line, text.color) : canvas.text(line, text.color);
  }
};

std::string hex(const Drawing::Color& color) {
  const auto part = [&](int k) { return static_cast<int>(std::lround(255 * color[k])); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

// escapes a text for XML; blanks replace control characters
std::string escaped(const std::string& text) {
  std::u32string letters = letters_of(text);
  std::erase_if(letters, [](char32_t c) { return c == 0xFFFE || c == 0xFFFF; });
  const std::string shown = text_of(letters);
  std::string out;
  for (size_t i = 0, size = 0; i < shown.size(); i += std::max<size_t>(size, 1)) {
    const char c = shown[i];
    size = control_size(shown, i);
    if (size > 0)
      out += ' ';
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

struct SvgWriter {
  std::string& out;

  void operator()(const Drawing::Line& line) const {
    if (line.points.empty()) return;
    if (line.points.size() == 1) {
      out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n",
                         line.points[0].x(), line.points[0].y(), line.width / 2, hex(line.color));
      return;
    }
    out += fmt::format(
        "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\" points=\"",
        hex(line.color), line.width);
    for (size_t i = 0; i < line.points.size(); ++i)
      out += fmt::format("{}{:.2f},{:.2f}", i ? " " : "", line.points[i].x(), line.points[i].y());
    out += "\"/>\n";
  }
  void operator()(const Drawing::Area& area) const {
    const Eigen::Vector2f size = area.high - area.low;
    out += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
        area.low.x(), area.low.y(), size.x(), size.y(), hex(area.color));
  }
  void operator()(const Drawing::Text& text) const {
    const std::string turned =
        text.upright
            ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", text.at.x(), text.at.y())
            : "";
    const std::string rim =
        text.rim ? fmt::format(
                       " stroke=\"#ffffff\" stroke-width=\"{}\" stroke-linejoin=\"round\" "
                       "paint-order=\"stroke\"",
                       rim_width)
                 : "";
    out += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-family=\"DejaVu Sans, sans-serif\" "
        "font-size=\"{:.2f}\" fill=\"{}\"{}{}>{}</text>\n",
        text.at.x(), text.at.y(), text.height / capital_height, hex(text.color), rim, turned,
        escaped(text.text));
  }
};

}  // namespace

Picture paint(const Drawing& drawing, const Font& font) {
  Picture picture = blank_picture(drawing.width, drawing.height);
  Canvas canvas(picture, font);
  for (const Drawing::Item& item : drawing.items) std::visit(ItemPainter{canvas}, item);
  return picture;
}

std::string svg_text(const Drawing& drawing) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      drawing.width, drawing.height);
  for (const Drawing::Item& item : drawing.items) std::visit(SvgWriter{out}, item);
  return out + "</svg>\n";
}

}  // namespace clench
