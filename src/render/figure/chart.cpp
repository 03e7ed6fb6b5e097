#include "clench/render/figure/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/math/round_step.h"
#include "clench/render/figure/axis_labels.h"
#include "clench/render/figure/pen.h"

namespace clench {

using Eigen::Vector2f;

namespace {

constexpr float letter_height = 9, title_height = 13, margin = 16, axis_room = 72;
// including the gap above, which holds the name [pixels]
constexpr float panel_height = 170, panel_gap = 56;
constexpr float min_gap = 0.6f;      // maximum gap, as a fraction of a panel
constexpr float value_room = 15;     // between a column and the panel's name [pixels]
constexpr float panel_name = 24;     // baseline of the name above the panel [pixels]
constexpr float min_lines = 13;      // minimum distance of the lines of an axis [pixels]
constexpr float min_column = 2;      // minimum height of a nonzero column [pixels]
constexpr float turned_label = 150;  // maximum length of an upright label [pixels]
// maximum length of an upright label, as a fraction of the chart's height
constexpr float turned_part = 0.25f;
constexpr int min_size = 64, largest_size = 8192;
constexpr size_t max_items = largest_size, max_values = 1'000'000;  // per series, and in total
constexpr size_t max_letters = 10'000'000;                          // of all texts together [bytes]

const Drawing::Color ink(0.13f, 0.16f, 0.20f), quiet(0.86f, 0.87f, 0.89f);
const Drawing::Color column_color(0.45f, 0.66f, 0.84f), best_color(0.09f, 0.40f, 0.67f);
const Drawing::Color cross_color(0.80f, 0.25f, 0.15f);

void check_chart(const Chart& chart, const ChartOptions& options) {
  if (chart.series.empty()) fail("chart: expected at least one series, got none");
  const size_t items = chart.series[0].values.size();
  if (items == 0)
    fail("chart: series '{}': expected at least one value, got none", chart.series[0].name);
  for (const ChartSeries& series : chart.series)
    if (series.values.size() != items)
      fail("chart: series '{}': expected {} values as in the first, got {}", series.name, items,
           series.values.size());
  if (items > max_items)
    fail(ErrorKind::limit, "chart: expected at most {} values per series, got {}", max_items,
         items);
  if (items * chart.series.size() > max_values)
    fail(ErrorKind::limit, "chart: expected at most {} values in all, got {} series of {}",
         max_values, chart.series.size(), items);
  size_t letters = chart.title.size();
  for (const std::string& label : chart.labels) letters += label.size();
  for (const ChartSeries& series : chart.series) letters += series.name.size();
  if (letters > max_letters)
    fail(ErrorKind::limit, "chart: expected texts of at most {} bytes in all, got {}", max_letters,
         letters);
  if (!chart.labels.empty() && chart.labels.size() != items)
    fail("chart: expected {} label{}, one per value, got {}", items, items == 1 ? "" : "s",
         chart.labels.size());
  if (options.width < min_size || options.width > largest_size)
    fail("chart: expected a width of {} to {} pixels, got {}", min_size, largest_size,
         options.width);
  if (options.height != 0 && (options.height < min_size || options.height > largest_size))
    fail("chart: expected a height of {} to {} pixels, got {}", min_size, largest_size,
         options.height);
}

std::vector<std::string> labels_of(const Chart& chart) {
  if (!chart.labels.empty()) return chart.labels;
  std::vector<std::string> numbers;
  for (size_t i = 1; i <= chart.series[0].values.size(); ++i) numbers.push_back(fmt::to_string(i));
  return numbers;
}

// horizontal positions of the columns, common to all panels
struct ChartColumns {
  float left, width;  // of one column, including the space next to it
  float center(size_t i) const { return left + (static_cast<float>(i) + 0.5f) * width; }
};

struct ChartPanel {
  float top, bottom, left, right;
  float name;  // baseline of the name above the top
};

// scale of a panel
struct ChartScale {
  ChartAxis axis;
  float top, bottom;
  float height(double value) const {
    // halves, so that the range of the largest numbers does not overflow
    const double part = (value / 2 - axis.low / 2) / (axis.high / 2 - axis.low / 2);
    return bottom - static_cast<float>(part) * (bottom - top);
  }
};

bool nothing_to_show(const std::vector<double>& values) {
  return std::ranges::none_of(values, [](double v) { return std::isfinite(v) && v != 0; });
}

// draws the line at 0 and, unless all values are zero, the other lines
void draw_axis(Pen& pen, const ChartPanel& panel, const ChartScale& scale, bool zeros) {
  const ChartAxis& axis = scale.axis;
  // indices of the lines, counted from 0
  const int first = floor_int(axis.low / axis.step + 0.5);
  const int last = floor_int(axis.high / axis.step + 0.5);
  const float apart = (scale.bottom - scale.top) / static_cast<float>(last - first);
  const int every = floor_between(std::ceil(min_lines / apart), 1, last - first + 1);
  for (int i = first; i <= last; ++i) {
    const double value = i * axis.step;
    // a line can overflow at the end of an axis of the largest numbers: it is skipped
    if ((zeros && i != 0) || i % every != 0 || !std::isfinite(value)) continue;
    const float y = scale.height(value);
    pen.rectangle({panel.left, y - 0.5f}, {panel.right, y + 0.5f}, quiet);
    const std::string number = fmt::format("{:.4g}", value);
    const float width = pen.font.width(number, letter_height);
    pen.text(number, {panel.left - 8 - width, y + letter_height / 2}, letter_height, ink);
  }
}

// infinite if there is none
double best_of(const ChartSeries& series) {
  const double sign = series.higher_is_better ? 1 : -1;
  double best = -std::numeric_limits<double>::infinity();
  for (const double value : series.values)
    if (std::isfinite(value)) best = std::max(best, sign * value);
  return sign * best;
}

void draw_cross(Pen& pen, float x, float zero) {
  pen.line({{x - 3, zero - 10}, {x + 3, zero - 4}}, 1.5f, cross_color);
  pen.line({{x - 3, zero - 4}, {x + 3, zero - 10}}, 1.5f, cross_color);
}

// y of the free end of a value's column; a nonzero value gets a visible height
float end_of(const ChartScale& scale, double value) {
  const float zero = scale.height(0), y = scale.height(value);
  if (value > 0) return std::min(y, zero - min_column);
  if (value < 0) return std::max(y, zero + min_column);
  return zero;
}

// writes the values above the columns, unless one is too wide
void write_values(Pen& pen, const ChartScale& scale, const std::vector<double>& values,
                  const ChartColumns& columns) {
  const auto width = [&](const std::string& text) { return pen.font.width(text, letter_height); };
  std::vector<std::string> numbers;
  for (const double value : values)
    numbers.push_back(std::isfinite(value) ? fmt::format("{:.3g}", value) : "");
  if (std::ranges::any_of(numbers, [&](const auto& n) { return width(n) > columns.width; })) return;
  for (size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]))
      pen.bright_text(numbers[i],
                      {columns.center(i) - width(numbers[i]) / 2,
                       std::min(end_of(scale, values[i]), scale.height(0)) - 4},
                      letter_height, ink);
}

void draw_columns(Pen& pen, const ChartPanel& panel, const ChartSeries& series,
                  const ChartColumns& columns) {
  const ChartScale scale{chart_axis(series.values), panel.top, panel.bottom};
  const float room = panel.right - panel.left;
  const std::string name = pen.font.shortened(series.name, letter_height, room);
  pen.text(name, {panel.left, panel.top - panel.name}, letter_height, ink);
  draw_axis(pen, panel, scale, nothing_to_show(series.values));

  const double best = best_of(series);
  const float half = std::max(0.5f, 0.36f * columns.width), zero = scale.height(0);
  for (size_t i = 0; i < series.values.size(); ++i) {
    const float x = columns.center(i);
    const double value = series.values[i];
    if (!std::isfinite(value)) {
      draw_cross(pen, x, zero);
      continue;
    }
    const float y = end_of(scale, value);
    pen.rectangle({x - half, std::min(y, zero)}, {x + half, std::max(y, zero)},
                  value == best ? best_color : column_color);
  }
  pen.rectangle({panel.left, zero - 0.5f}, {panel.right, zero + 0.5f}, ink);
  if (panel.name >= value_room) write_values(pen, scale, series.values, columns);
}

}  // namespace

ChartAxis chart_axis(const std::vector<double>& values) {
  double low = 0, high = 0;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  // halves first, so that the range of the largest numbers does not overflow
  const double range = high / 2 - low / 2;
  // with a smaller range the step would underflow
  if (range < 1e-300) return {};
  const double step = round_step(range / 2);
  constexpr double largest = std::numeric_limits<double>::max();
  return {std::max(std::floor(low / step) * step, -largest),
          std::min(std::ceil(high / step) * step, largest), step};
}

Drawing draw_chart(const Chart& chart, const ChartOptions& options, const Font& font) {
  check_chart(chart, options);
  const float left = margin + axis_room, right = static_cast<float>(options.width) - margin;
  const auto items = static_cast<float>(chart.series[0].values.size());
  const ChartColumns columns{left, (right - left) / items};
  const float longest =
      options.height > 0 ? std::min(turned_label, turned_part * static_cast<float>(options.height))
                         : turned_label;
  const AxisLabels labels(labels_of(chart), columns.width, longest, letter_height, font);
  const float above = chart.title.empty() ? 0 : title_height + margin;
  const float below = 8 + labels.room() + margin;
  const auto panels = static_cast<float>(chart.series.size());
  const float needed = margin + above + panels * panel_height + below;
  const int height =
      options.height > 0 ? options.height : floor_between(needed, min_size, largest_size);

  Drawing drawing{options.width, height};
  Pen pen{drawing, font};
  const std::string title = font.shortened(chart.title, title_height, right - margin);
  pen.text(title, {margin, margin + title_height}, title_height, ink);
  const float room = (static_cast<float>(height) - margin - above - below) / panels;
  // low panels have smaller gaps
  const float gap = std::min(panel_gap, min_gap * room);
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const float top = margin + above + static_cast<float>(i) * room + gap;
    const float name = panel_name * gap / panel_gap;
    draw_columns(pen, {top, std::max(top + 1, top + room - gap), left, right, name},
                 chart.series[i], columns);
  }
  labels.draw(
      pen, static_cast<float>(height) - below + 8, [&](size_t i) { return columns.center(i); },
      ink);
  return drawing;
}

}  // namespace clench
