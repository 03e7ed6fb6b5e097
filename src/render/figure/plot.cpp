#include "clench/render/figure/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/render/figure/axis_labels.h"
#include "clench/render/figure/pen.h"
#include "clench/render/figure/plot_scale.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector2f;

namespace {

constexpr float text_height = 10, heading_height = 13, border = 14, gap = 8;  // [pixels]
constexpr float line_width = 2, point_width = 6, frame_width = 1, sample_length = 24;
// minimum distance of two lines of an axis [pixels]
constexpr double tick_room_x = 90, tick_room_y = 45;
// margin beyond the outermost values, as a fraction of the range
constexpr double margin_of_data = 0.04;
// of all bars of a category, as a fraction of the distance to the next
constexpr double group_width = 0.8;
constexpr float longest_label = 0.3f;  // of an upright label, as a fraction of the figure's height
constexpr int min_plot_size = 64, max_plot_size = 8192;
constexpr size_t max_points = 200'000;
constexpr double largest_shown = 1e300;

const Drawing::Color dark(0.13f, 0.16f, 0.20f), grid(0.88f, 0.89f, 0.91f);
const Drawing::Color series_colors[] = {{0.000f, 0.447f, 0.698f}, {0.835f, 0.369f, 0.000f},
                                        {0.000f, 0.620f, 0.451f}, {0.800f, 0.475f, 0.655f},
                                        {0.902f, 0.624f, 0.000f}, {0.337f, 0.706f, 0.914f},
                                        {0.350f, 0.350f, 0.350f}};

bool shown(double value) { return std::abs(value) <= largest_shown; }

// can its ends be distinguished, with lines between them?
bool wide_enough(const Range& range) {
  const double size = range[1] - range[0];
  return size > 1e-12 * std::max(std::abs(range[0]), std::abs(range[1])) && size > 1e-300;
}

std::string name_of(const PlotSeries& series, size_t number) {
  return series.name.empty() ? fmt::format("plot: series {}", number)
                             : fmt::format("plot: series {}", in_quotes(series.name));
}

// categories need one value each, and no numbers along their axis
void check_categories(const Plot& plot) {
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const std::string subject = name_of(series, i + 1);
    if (!series.x.empty())
      fail("{}: expected no x, because categories are along that axis", subject);
    if (series.y.size() != plot.categories.size())
      fail("{}: expected {} values, one per category, got {}", subject, plot.categories.size(),
           series.y.size());
  }
  if (plot.x.range) fail("plot: x_range: not allowed with categories");
  if (plot.x.logarithmic) fail("plot: x_scale: not allowed with categories");
}

void check_series(const PlotSeries& series, size_t number) {
  const std::string subject = name_of(series, number);
  const size_t wanted = series.y.size() + (series.kind == PlotKind::bars ? 1 : 0);
  if (series.y.empty()) fail("{}: expected at least one value, got none", subject);
  if (series.x.size() != wanted)
    fail("{}: expected {} {}, got {}", subject, wanted,
         series.kind == PlotKind::bars ? "edges of bars" : "values of x, as there are of y",
         series.x.size());
  if (series.kind == PlotKind::bars)
    for (size_t i = 0; i < series.x.size(); ++i)
      if (!shown(series.x[i]) || (i > 0 && !(series.x[i] > series.x[i - 1])))
        fail("{}: expected ascending edges, got {} as number {}", subject, series.x[i], i + 1);
}

bool any_bars(const Plot& plot) {
  return std::ranges::any_of(plot.series,
                             [](const PlotSeries& s) { return s.kind == PlotKind::bars; });
}

void check_plot(const Plot& plot) {
  if (plot.series.empty()) fail("plot: expected at least one series, got none");
  if (!plot.categories.empty()) check_categories(plot);
  size_t points = 0;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    if (plot.categories.empty()) check_series(plot.series[i], i + 1);
    points += plot.series[i].y.size();
  }
  if (points > max_points)
    fail(ErrorKind::limit, "plot: expected at most {} values in all, got {}", max_points, points);
  for (const auto& [name, size] : {std::pair("width", plot.width), {"height", plot.height}})
    if (size < min_plot_size || size > max_plot_size)
      fail("plot: expected a {} of {} to {} pixels, got {}", name, min_plot_size, max_plot_size,
           size);
  for (const auto& [name, axis] : {std::pair("x", &plot.x), {"y", &plot.y}}) {
    if (axis == &plot.y && axis->logarithmic && any_bars(plot))
      fail("plot: y_scale: bars begin at 0, which a logarithmic axis does not include");
    for (size_t i = 0; axis == &plot.x && axis->logarithmic && i < plot.series.size(); ++i)
      if (plot.series[i].kind == PlotKind::bars && !(plot.series[i].x[0] > 0))
        fail("plot: x_scale: expected edges of bars > 0 on a logarithmic axis, got {}",
             plot.series[i].x[0]);
    if (!axis->range) continue;
    const auto [low, high] = *axis->range;
    if (!shown(low) || !shown(high) || !wide_enough({low, high}))
      fail("plot: {}_range: expected a lower and a higher number, got {} and {}", name, low, high);
    if (axis->logarithmic && !(low > 0))
      fail("plot: {}_range: expected numbers > 0 on a logarithmic axis, got {} and {}", name, low,
           high);
  }
}

// width of one bar of a category
double bar_width(const Plot& plot) {
  return group_width /
         static_cast<double>(std::ranges::count(plot.series, PlotKind::bars, &PlotSeries::kind));
}

// places categories at 1, 2, 3 ..., and the bars of several series next to each other around them
void place_categories(Plot& plot) {
  double before = 0;
  for (PlotSeries& series : plot.series) {
    const bool bar = series.kind == PlotKind::bars;
    for (size_t i = 1; i <= plot.categories.size(); ++i) {
      const double left = static_cast<double>(i) - group_width / 2;
      series.x.push_back(bar ? left + before * bar_width(plot) : static_cast<double>(i));
    }
    before += bar;
  }
  plot.x.range = {0.5, static_cast<double>(plot.categories.size()) + 0.5};
}

double right_edge(const Plot& plot, const PlotSeries& bars, size_t i) {
  return plot.categories.empty() ? bars.x[i + 1] : bars.x[i] + bar_width(plot);
}

// extends a range to include a value
void hold(Range& range, double value) {
  range = {std::min(range[0], value), std::max(range[1], value)};
}

// ranges of the drawn data; lower end above the upper one: there are none
std::array<Range, 2> data_ranges(const Plot& plot) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range xs = {infinity, -infinity}, ys = xs;
  for (const PlotSeries& series : plot.series)
    for (size_t i = 0; i < series.y.size(); ++i) {
      if (!shown(series.y[i]) || !shown(series.x[i])) continue;
      hold(xs, series.x[i]);
      hold(ys, series.y[i]);
      if (series.kind == PlotKind::bars) hold(xs, right_edge(plot, series, i)), hold(ys, 0);
    }
  return {xs, ys};
}

// adds a margin around the data; bars begin at the axis and may reach its ends
Range with_margin(const Range& data, bool low_end, bool high_end) {
  if (!wide_enough(data)) {
    const double room = std::max(1.0, std::abs(data[0])) / 2;
    return {data[0] - room, data[1] + room};
  }
  const double size = data[1] - data[0];
  return {data[0] - (low_end ? margin_of_data * size : 0),
          data[1] + (high_end ? margin_of_data * size : 0)};
}

// replaces numbers of a logarithmic axis by their common logarithms; NaN if not > 0
void take_logarithms(const PlotAxis& axis, std::vector<double>& values) {
  if (!axis.logarithmic) return;
  for (double& value : values) value = value > 0 ? std::log10(value) : NAN;
}

Plot in_scale(const Plot& plot) {
  Plot out = plot;
  if (!out.categories.empty()) place_categories(out);
  for (PlotSeries& series : out.series) {
    take_logarithms(out.x, series.x);
    take_logarithms(out.y, series.y);
  }
  for (PlotAxis* axis : {&out.x, &out.y})
    if (axis->logarithmic && axis->range)
      axis->range = {std::log10((*axis->range)[0]), std::log10((*axis->range)[1])};
  return out;
}

/// The figure under construction.
class Figure {
 public:
  Figure(const Plot& plot, const Font& font)
      : plot_(plot), font_(font), out_{plot.width, plot.height} {}
  Drawing draw();

 private:
  float width_of(const std::string& text) const { return font_.width(text, text_height); }
  void text(const std::string& text, const Vector2f& at, float height = text_height,
            bool upright = false) {
    pen_.text(text, at, height, dark, upright);
  }
  void line(std::vector<Vector2f> points, float width, const Drawing::Color& color) {
    pen_.line(std::move(points), width, color);
  }
  float draw_heading();
  void set_scales(float top);
  void draw_axes();
  void draw_series(const PlotSeries& series, const Drawing::Color& color);
  void draw_bars(const PlotSeries& series, const Drawing::Color& color);
  void draw_line(const PlotSeries& series, const Drawing::Color& color);
  bool inside(double x, double y) const {
    return x >= x_.range[0] && x <= x_.range[1] && y >= y_.range[0] && y <= y_.range[1];
  }
  Vector2f at(const Vector2d& p) const { return {x_.at(p.x()), y_.at(p.y())}; }

  const Plot& plot_;
  const Font& font_;
  Drawing out_;
  Pen pen_{out_, font_};
  PlotScale x_, y_;
  std::optional<AxisLabels> labels_;  // of categories
};

// draws title and legend
// returns  their lower edge
float Figure::draw_heading() {
  float top = border;
  const float room = static_cast<float>(plot_.width) - 2 * border;
  if (!plot_.title.empty()) {
    top += heading_height;
    text(font_.shortened(plot_.title, heading_height, room), {border, top}, heading_height);
    top += gap;
  }
  float x = border;
  bool any = false;
  for (size_t i = 0; i < plot_.series.size(); ++i) {
    const PlotSeries& series = plot_.series[i];
    if (series.name.empty()) continue;
    if (!any) top += text_height + gap / 2;
    any = true;
    const std::string name = font_.shortened(series.name, text_height, room - sample_length - gap);
    const float needed = sample_length + gap + width_of(name);
    if (x > border && x + needed > border + room) x = border, top += text_height + gap;
    const Drawing::Color& color = series_colors[i % std::size(series_colors)];
    const float middle = top - text_height / 2;
    if (series.kind == PlotKind::line)
      line({{x, middle}, {x + sample_length, middle}}, line_width, color);
    else if (series.kind == PlotKind::points)
      line({{x + sample_length / 2, middle}}, point_width, color);
    else
      pen_.rectangle({x, top - text_height}, {x + sample_length, top}, color);
    text(name, {x + sample_length + gap, top});
    x += needed + 3 * gap;
  }
  return any ? top + gap : top;
}

// sets the frame of the axes, and the ranges that they show
void Figure::set_scales(float top) {
  const auto [xs, ys] = data_ranges(plot_);
  if (!(xs[0] <= xs[1]) && !(plot_.x.range && plot_.y.range))
    fail("plot: expected at least one finite value, got none");
  const bool bars = any_bars(plot_);
  const Range x_range = plot_.x.range ? *plot_.x.range : with_margin(xs, !bars, !bars);
  const Range y_range =
      plot_.y.range ? *plot_.y.range : with_margin(ys, !bars || ys[0] < 0, !bars || ys[1] > 0);
  const float height = static_cast<float>(plot_.height);
  const float end = height - border - (plot_.x.label.empty() ? 0 : text_height + gap);
  const auto set_y = [&](float labels) {
    const float bottom = end - labels - gap;
    y_ = make_scale(y_range, bottom - top, tick_room_y, plot_.y.logarithmic);
    y_.from = std::max(bottom, top + 1), y_.to = top + text_height / 2;
  };
  set_y(text_height);
  float widest = 0;
  for (const double value : y_.lines()) widest = std::max(widest, width_of(y_.text(value)));
  const float left = border + (plot_.y.label.empty() ? 0 : text_height + gap) + widest + gap;
  const float right = static_cast<float>(plot_.width) - 2 * border;
  x_ = make_scale(x_range, right - left, tick_room_x, plot_.x.logarithmic);
  x_.from = left, x_.to = std::max(right, left + 1);
  if (plot_.categories.empty()) return;
  // upright labels reduce the height, which cannot increase the number of lines
  labels_.emplace(plot_.categories, x_.at(2) - x_.at(1), longest_label * height, text_height,
                  font_);
  set_y(labels_->room());
}

void Figure::draw_axes() {
  const float low = y_.from, high = y_.to;
  if (labels_)
    labels_->draw(
        pen_, low + gap, [&](size_t i) { return x_.at(static_cast<double>(i + 1)); }, dark);
  for (const double value : labels_ ? std::vector<double>{} : x_.lines()) {
    const float x = x_.at(value);
    line({{x, low}, {x, high}}, frame_width, grid);
    const std::string number = x_.text(value);
    text(number, {x - width_of(number) / 2, low + gap + text_height});
  }
  for (const double value : y_.lines()) {
    const float y = y_.at(value);
    line({{x_.from, y}, {x_.to, y}}, frame_width, grid);
    const std::string number = y_.text(value);
    text(number, {x_.from - gap - width_of(number), y + text_height / 2});
  }
  const float across = x_.to - x_.from, along = low - high;
  const std::string x_label = font_.shortened(plot_.x.label, text_height, across);
  if (!x_label.empty())
    text(x_label,
         {x_.from + (across - width_of(x_label)) / 2, static_cast<float>(plot_.height) - border});
  const std::string y_label = font_.shortened(plot_.y.label, text_height, along);
  if (!y_label.empty())
    text(y_label, {border + text_height, low - (along - width_of(y_label)) / 2}, text_height, true);
}

void Figure::draw_bars(const PlotSeries& series, const Drawing::Color& color) {
  const auto within = [](const Range& range, double v) {
    return std::clamp(v, range[0], range[1]);
  };
  for (size_t i = 0; i < series.y.size(); ++i) {
    if (!shown(series.y[i])) continue;
    const double left = within(x_.range, series.x[i]),
                 right = within(x_.range, right_edge(plot_, series, i));
    const double low = within(y_.range, std::min(0.0, series.y[i])),
                 high = within(y_.range, std::max(0.0, series.y[i]));
    if (!(left < right) || !(low < high)) continue;
    const Vector2f from = at({left, high}), to = at({right, low});
    // a thin gap between neighbors, if the bars are wide enough
    const float space = to.x() - from.x() > 4 ? 0.5f : 0;
    pen_.rectangle(from + Vector2f(space, 0), to - Vector2f(space, 0), color);
  }
}

// the part of a segment within the axes, by Liang and Barsky (1984); empty if it lies outside
std::optional<std::array<Vector2d, 2>> clipped(const Vector2d& a, const Vector2d& b,
                                               const Range& xs, const Range& ys) {
  double t0 = 0, t1 = 1;
  const Vector2d d = b - a;
  for (int k = 0; k < 2; ++k) {
    const Range& range = k == 0 ? xs : ys;
    for (const double sign : {-1.0, 1.0}) {
      const double out = sign * d[k];
      const double room = sign < 0 ? a[k] - range[0] : range[1] - a[k];
      if (out == 0 && room < 0) return {};
      if (out < 0) t0 = std::max(t0, room / out);
      if (out > 0) t1 = std::min(t1, room / out);
    }
  }
  if (t0 > t1) return {};
  return std::array{Vector2d(a + t0 * d), Vector2d(a + t1 * d)};
}

void Figure::draw_line(const PlotSeries& series, const Drawing::Color& color) {
  std::vector<Vector2f> points;
  const auto finish = [&] {
    line(std::move(points), line_width, color);
    points.clear();
  };
  for (size_t i = 0; i < series.y.size(); ++i) {
    const Vector2d p(series.x[i], series.y[i]);
    const auto here = [&](size_t k) { return shown(series.x[k]) && shown(series.y[k]); };
    if (!here(i)) {
      finish();
      continue;
    }
    const bool alone = (i == 0 || !here(i - 1)) && (i + 1 == series.y.size() || !here(i + 1));
    if (alone && inside(p.x(), p.y())) line({at(p)}, point_width / 2, color);
    if (i == 0 || !here(i - 1)) continue;
    const auto part = clipped({series.x[i - 1], series.y[i - 1]}, p, x_.range, y_.range);
    if (!part) {
      finish();
      continue;
    }
    if (points.empty() || points.back() != at((*part)[0])) {
      finish();
      points.push_back(at((*part)[0]));
    }
    points.push_back(at((*part)[1]));
  }
  finish();
}

void Figure::draw_series(const PlotSeries& series, const Drawing::Color& color) {
  if (series.kind == PlotKind::bars) return draw_bars(series, color);
  if (series.kind == PlotKind::line) return draw_line(series, color);
  for (size_t i = 0; i < series.y.size(); ++i)
    if (shown(series.x[i]) && shown(series.y[i]) && inside(series.x[i], series.y[i]))
      line({at({series.x[i], series.y[i]})}, point_width, color);
}

Drawing Figure::draw() {
  set_scales(draw_heading());
  draw_axes();
  for (size_t i = 0; i < plot_.series.size(); ++i)
    draw_series(plot_.series[i], series_colors[i % std::size(series_colors)]);
  line({{x_.from, y_.to}, {x_.from, y_.from}, {x_.to, y_.from}}, frame_width, dark);
  // the line at 0, if some bars are negative and some are not
  if (any_bars(plot_) && y_.range[0] < 0 && y_.range[1] > 0)
    line({{x_.from, y_.at(0)}, {x_.to, y_.at(0)}}, frame_width, dark);
  return std::move(out_);
}

}  // namespace

Drawing draw_plot(const Plot& plot, const Font& font) {
  check_plot(plot);
  const Plot scaled = in_scale(plot);
  return Figure(scaled, font).draw();
}

}  // namespace clench
