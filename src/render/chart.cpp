#include "render/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "render/canvas.h"

namespace clench {

using Eigen::Vector2f;

namespace {

constexpr float letter_height = 9, title_height = 13, margin = 16, axis_room = 72;
constexpr float panel_height = 120, panel_gap = 30;
constexpr int least_size = 64, largest_size = 8192;

const Canvas::Color ink(0.13f, 0.16f, 0.20f), quiet(0.86f, 0.87f, 0.89f);
const Canvas::Color column_color(0.45f, 0.66f, 0.84f), best_color(0.09f, 0.40f, 0.67f);
const Canvas::Color cross_color(0.80f, 0.25f, 0.15f);

void check_chart(const Chart& chart, const ChartOptions& options) {
  if (chart.series.empty()) fail("chart: wanted at least one series, got none");
  const size_t items = chart.series[0].values.size();
  if (items == 0)
    fail("chart: series '{}': wanted at least one value, got none", chart.series[0].name);
  for (const ChartSeries& series : chart.series)
    if (series.values.size() != items)
      fail("chart: series '{}': wanted {} values, as the first has, got {}", series.name, items,
           series.values.size());
  if (!chart.labels.empty() && chart.labels.size() != items)
    fail("chart: wanted {} labels, one a value, got {}", items, chart.labels.size());
  if (options.width < least_size || options.width > largest_size)
    fail("chart: wanted a width of {} to {} pixels, got {}", least_size, largest_size,
         options.width);
  if (options.height != 0 && (options.height < least_size || options.height > largest_size))
    fail("chart: wanted a height of {} to {} pixels, got {}", least_size, largest_size,
         options.height);
}

std::vector<std::string> labels_of(const Chart& chart) {
  if (!chart.labels.empty()) return chart.labels;
  std::vector<std::string> numbers;
  for (size_t i = 1; i <= chart.series[0].values.size(); ++i) numbers.push_back(fmt::to_string(i));
  return numbers;
}

// where the columns of all panels stand
struct ChartColumns {
  float left, width;  // of one column, with the space beside it
  float centre(size_t i) const { return left + (static_cast<float>(i) + 0.5f) * width; }
};

struct ChartPanel {
  float top, bottom, left, right;
};

void draw_columns(Canvas& canvas, const ChartPanel& panel, const ChartSeries& series,
                  const ChartColumns& columns) {
  const ChartAxis axis = chart_axis(series.values);
  const auto height = [&](double value) {
    const double part = (value - axis.low) / (axis.high - axis.low);
    return panel.bottom - static_cast<float>(part) * (panel.bottom - panel.top);
  };
  canvas.text(series.name, {panel.left, panel.top - 8}, letter_height, ink);

  // lines of the axis with their values
  const auto steps = std::lround((axis.high - axis.low) / axis.step);
  for (long i = 0; i <= steps; ++i) {
    const double value = axis.low + static_cast<double>(i) * axis.step;
    const float y = height(value);
    canvas.rectangle({panel.left, y - 0.5f}, {panel.right, y + 0.5f}, quiet);
    const std::string number = fmt::format("{:.4g}", std::abs(value) < axis.step / 2 ? 0.0 : value);
    canvas.text(number,
                {panel.left - 8 - Canvas::text_width(number, letter_height), y + letter_height / 2},
                letter_height, ink);
  }

  double best = -std::numeric_limits<double>::infinity();
  for (const double value : series.values)
    if (std::isfinite(value)) best = std::max(best, value);
  const float half = std::max(0.5f, 0.36f * columns.width), zero = height(0);
  for (size_t i = 0; i < series.values.size(); ++i) {
    const float x = columns.centre(i);
    const double value = series.values[i];
    if (std::isfinite(value)) {
      const float y = height(value);
      canvas.rectangle({x - half, std::min(y, zero)}, {x + half, std::max(y, zero)},
                       value == best ? best_color : column_color);
    } else {
      canvas.line({x - 3, zero - 8}, {x + 3, zero - 2}, 1.5f, cross_color);
      canvas.line({x - 3, zero - 2}, {x + 3, zero - 8}, 1.5f, cross_color);
    }
  }
  canvas.rectangle({panel.left, zero - 0.5f}, {panel.right, zero + 0.5f}, ink);
}

// under the last panel: level where they fit, upright where not, some left out where even those would overlap
void draw_labels(Canvas& canvas, const std::vector<std::string>& labels, float top,
                 const ChartColumns& columns, bool upright) {
  const float least = upright ? letter_height + 4 : 0;
  const size_t every = upright ? static_cast<size_t>(std::ceil(least / columns.width)) : 1;
  for (size_t i = 0; i < labels.size(); i += std::max<size_t>(1, every)) {
    const float width = Canvas::text_width(labels[i], letter_height), x = columns.centre(i);
    if (upright)
      canvas.text(labels[i], {x + letter_height / 2, top + width}, letter_height, ink,
                  -Vector2f::UnitY());
    else
      canvas.text(labels[i], {x - width / 2, top + letter_height}, letter_height, ink);
  }
}

}  // namespace

ChartAxis chart_axis(const std::vector<double>& values) {
  double low = 0, high = 0;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  // halves first, so that the range of the largest numbers is one
  double range = high / 2 - low / 2;
  // beside numbers that small a step would be none
  if (range < 1e-300) return {};
  const double rough = range / 2;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= rough) step = digit * power;
  return {std::floor(low / step) * step, std::ceil(high / step) * step, step};
}

Picture draw_chart(const Chart& chart, const ChartOptions& options) {
  check_chart(chart, options);
  const std::vector<std::string> labels = labels_of(chart);
  float widest = 0;
  for (const std::string& label : labels)
    widest = std::max(widest, Canvas::text_width(label, letter_height));

  const float left = margin + axis_room, right = static_cast<float>(options.width) - margin;
  const ChartColumns columns{left, (right - left) / static_cast<float>(labels.size())};
  const bool upright = widest + 4 > columns.width;
  const float above = chart.title.empty() ? 0 : title_height + margin;
  const float below = 8 + (upright ? widest : letter_height) + margin;
  const auto panels = static_cast<float>(chart.series.size());
  const int needed = static_cast<int>(margin + above + panels * (panel_height + panel_gap) + below);
  const int height =
      options.height > 0 ? options.height : std::clamp(needed, least_size, largest_size);

  Picture picture = blank_picture(options.width, height);
  Canvas canvas(picture);
  if (!chart.title.empty())
    canvas.text(chart.title, {margin, margin + title_height}, title_height, ink);
  const float room = (static_cast<float>(height) - margin - above - below) / panels;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const float top = margin + above + static_cast<float>(i) * room;
    draw_columns(canvas, {top + panel_gap, std::max(top + panel_gap + 1, top + room), left, right},
                 chart.series[i], columns);
  }
  draw_labels(canvas, labels, static_cast<float>(height) - below + 8, columns, upright);
  return picture;
}

}  // namespace clench
