#include "clench/render/figure/plot.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/render/figure/sheet.h"
#include "letters.h"

using namespace clench;
using clench::test::letters;
using Eigen::Vector2f;

namespace {

template <class Item>
std::vector<Item> items_of(const Drawing& drawing) {
  std::vector<Item> out;
  for (const auto& item : drawing.items)
    if (const Item* one = std::get_if<Item>(&item)) out.push_back(*one);
  return out;
}

// lines of the data; those of axes are thinner
std::vector<Drawing::Line> data_lines(const Drawing& drawing) {
  auto lines = items_of<Drawing::Line>(drawing);
  std::erase_if(lines, [](const Drawing::Line& line) { return line.width <= 1; });
  return lines;
}

bool has_text(const Drawing& drawing, const std::string& text) {
  return std::ranges::any_of(items_of<Drawing::Text>(drawing),
                             [&](const Drawing::Text& t) { return t.text == text; });
}

Plot of(PlotSeries series) {
  Plot plot;
  plot.series = {std::move(series)};
  return plot;
}

}  // namespace

TEST_CASE("points are at the positions given by the numbers of the axes") {
  const Drawing drawing =
      draw_plot(of({.kind = PlotKind::points, .x = {0, 5, 10}, .y = {-1, 0, 1}}), letters());
  const auto points = data_lines(drawing);
  REQUIRE(points.size() == 3);
  // evenly spaced numbers are evenly spaced points
  const Vector2f first = points[0].points[0], middle = points[1].points[0],
                 last = points[2].points[0];
  CHECK((first + last - 2 * middle).norm() < 1e-3f);
  CHECK(first.x() < last.x());
  CHECK(first.y() > last.y());
  // the vertical lines of the axis, at 0, 2, 4 ...: the first and the last point are on two of them
  std::vector<float> upright;
  for (const auto& line : items_of<Drawing::Line>(drawing))
    if (line.points.size() == 2 && line.points[0].x() == line.points[1].x())
      upright.push_back(line.points[0].x());
  for (const float x : {first.x(), last.x()})
    CHECK(std::ranges::any_of(upright, [&](float u) { return std::abs(u - x) < 1e-3f; }));
  for (const char* number : {"0", "2", "10", "-0.5"}) CHECK(has_text(drawing, number));
}

TEST_CASE("a line has gaps at missing numbers, and a single number is a dot") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  const auto lines = data_lines(
      draw_plot(of({.x = {0, 1, 2, 3, 4, 5, 6}, .y = {0, 1, nan, 2, infinity, 3, 4}}), letters()));
  REQUIRE(lines.size() == 3);
  std::vector<size_t> sizes;
  for (const auto& line : lines) sizes.push_back(line.points.size());
  std::ranges::sort(sizes);
  CHECK(sizes == std::vector<size_t>{1, 2, 2});
}

TEST_CASE("the part of a line inside a range is drawn, compared with many points on it") {
  Random random(1);
  for (int n = 0; n < 200; ++n) {
    Plot plot = of({.x = {random.uniform(-3, 3), random.uniform(-3, 3)},
                    .y = {random.uniform(-3, 3), random.uniform(-3, 3)}});
    plot.x.range = plot.y.range = std::array{-1.0, 1.0};
    const auto lines = data_lines(draw_plot(plot, letters()));
    const PlotSeries& s = plot.series[0];
    int inside = 0;
    constexpr int samples = 20000;
    for (int i = 0; i <= samples; ++i) {
      const double t = i / double{samples};
      const double x = s.x[0] + t * (s.x[1] - s.x[0]), y = s.y[0] + t * (s.y[1] - s.y[0]);
      inside += std::abs(x) <= 1 && std::abs(y) <= 1;
    }
    // as a fraction of the line: sampling has an error of a few of its distances
    const double whole = std::hypot((s.x[1] - s.x[0]), (s.y[1] - s.y[0]));
    if (inside == 0) {
      CHECK((lines.empty() || (lines[0].points[1] - lines[0].points[0]).norm() < 0.5f));
      continue;
    }
    REQUIRE(lines.size() == 1);
    // pixels of the two axes differ: measured along x, or along y if that is longer
    Plot unit = of({.kind = PlotKind::points, .x = {-1, 1}, .y = {-1, 1}});
    unit.x.range = unit.y.range = plot.x.range;
    const auto corners = data_lines(draw_plot(unit, letters()));
    const Vector2f size = corners[1].points[0] - corners[0].points[0];
    const Vector2f drawn = lines[0].points[1] - lines[0].points[0];
    const double length =
        std::hypot(2.0 * drawn.x() / size.x(), 2.0 * drawn.y() / size.y()) / whole;
    CHECK(length == doctest::Approx(inside / double{samples}).epsilon(0.01).scale(0.01));
  }
}

TEST_CASE("bars stand on 0 between their edges, and their axis contains 0") {
  const auto bars = items_of<Drawing::Area>(
      draw_plot(of({.kind = PlotKind::bars, .x = {0, 1, 2, 4}, .y = {10, 20, -5}}), letters()));
  REQUIRE(bars.size() == 3);
  const float zero = bars[0].high.y();
  CHECK(bars[1].high.y() == zero);
  CHECK(bars[2].low.y() == zero);
  CHECK(2 * (zero - bars[0].low.y()) == doctest::Approx(zero - bars[1].low.y()).epsilon(1e-4));
  // the last bar is twice as wide, except for the gaps between bars
  CHECK(bars[2].high.x() - bars[2].low.x() + 1 ==
        doctest::Approx(2 * (bars[0].high.x() - bars[0].low.x() + 1)).epsilon(1e-3));
}

TEST_CASE("on a logarithmic axis equal ratios are equal distances, and values <= 0 are omitted") {
  Plot plot;
  plot.series = {{.kind = PlotKind::points, .x = {1, 10, 100, 0, -3}, .y = {1, 1, 1, 1, 1}}};
  plot.x.logarithmic = true;
  std::vector<float> xs;
  for (const Drawing::Item& item : draw_plot(plot, letters()).items)
    if (const auto* line = std::get_if<Drawing::Line>(&item); line && line->points.size() == 1)
      xs.push_back(line->points[0].x());
  REQUIRE(xs.size() == 3);
  CHECK(xs[1] - xs[0] == doctest::Approx(xs[2] - xs[1]));
}

TEST_CASE(
    "lines of a logarithmic axis are at powers of ten, and at 2 and 5 times them if these are "
    "few") {
  const auto numbers = [](double low, double high) {
    Plot plot;
    plot.series = {{.x = {1, 2}, .y = {low, high}}};
    plot.y.logarithmic = true;
    plot.y.range = {low, high};
    plot.x.range = {1, 2};
    std::vector<std::string> out;
    for (const Drawing::Item& item : draw_plot(plot, letters()).items)
      if (const auto* text = std::get_if<Drawing::Text>(&item)) out.push_back(text->text);
    return out;
  };
  const auto holds = [](const std::vector<std::string>& all, const std::vector<std::string>& some) {
    return std::ranges::all_of(
        some, [&](const std::string& s) { return std::ranges::count(all, s) > 0; });
  };
  CHECK(holds(numbers(1, 100), {"5", "10", "20", "50", "100"}));
  CHECK(holds(numbers(0.001, 1000), {"0.001", "0.1", "1", "10", "1000"}));
  CHECK(holds(numbers(1e-30, 1e30), {"1", "1e10"}));
  // for large and small values alike
  CHECK(holds(numbers(1e-4, 1e4), {"1e-4", "1", "1e4"}));
  // ranges of less than a decade show all digits
  CHECK(holds(numbers(0.2, 0.7), {"0.2", "0.3", "0.4", "0.5", "0.6", "0.7"}));
}

TEST_CASE("a logarithmic axis rejects ranges that it cannot show") {
  Plot plot;
  plot.series = {{.x = {1, 2}, .y = {1, 2}}};
  plot.y = {.range = {{0, 1}}, .logarithmic = true};
  CHECK_THROWS_WITH_AS(draw_plot(plot, letters()),
                       "plot: y_range: expected numbers > 0 on a logarithmic axis, got 0 and 1",
                       Error);
  plot.y.range.reset();
  plot.series = {{.kind = PlotKind::bars, .x = {0, 1}, .y = {2}}};
  CHECK_THROWS_WITH_AS(draw_plot(plot, letters()),
                       "plot: y_scale: bars begin at 0, which a logarithmic axis does not include",
                       Error);
  plot.y.logarithmic = false, plot.x.logarithmic = true;
  CHECK_THROWS_WITH_AS(draw_plot(plot, letters()),
                       "plot: x_scale: expected edges of bars > 0 on a logarithmic axis, got 0",
                       Error);
}

TEST_CASE("any finite numbers make a figure") {
  for (const auto& [x, y] : {std::pair(std::vector<double>{1e17, 1e17 + 32}, std::vector{1.0, 2.0}),
                             {{0, 1}, {5, 5}},
                             {{0, 0}, {0, 0}},
                             {{-1e300, 1e300}, {1e-300, 2e-300}},
                             {{1, 1 + 1e-15}, {-1e-9, 1e-9}}}) {
    const Drawing drawing = draw_plot(of({.x = x, .y = y}), letters());
    CHECK(drawing.items.size() < 200);
    for (const auto& line : items_of<Drawing::Line>(drawing))
      for (const Vector2f& p : line.points) {
        CHECK(p.allFinite());
        CHECK((p.x() >= 0 && p.x() <= 720 && p.y() >= 0 && p.y() <= 480));
      }
  }
}

TEST_CASE("a figure in SVG has the same parts, and its texts cannot close its elements") {
  Plot plot = of({.name = "<&> \x01", .x = {0, 1}, .y = {0, 1}});
  plot.title = "</svg>";
  const std::string svg = svg_text(draw_plot(plot, letters()));
  CHECK(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"720\" height=\"480\""));
  CHECK(svg.find("&lt;/svg&gt;") != std::string::npos);
  CHECK(svg.find("&lt;&amp;&gt;  <") != std::string::npos);
  CHECK(svg.find("</svg>") == svg.size() - 7);
  CHECK(svg.find("<polyline") != std::string::npos);
}

TEST_CASE("a plot that cannot be drawn is rejected") {
  const auto refused = [](Plot plot, const char* message) {
    CHECK_THROWS_WITH_AS(draw_plot(plot, letters()), message, Error);
  };
  refused({}, "plot: expected at least one series, got none");
  refused(of({.x = {1}, .y = {}}), "plot: series 1: expected at least one value, got none");
  refused(of({.name = "e", .x = {1}, .y = {1, 2}}),
          "plot: series 'e': expected 2 values of x, as there are of y, got 1");
  refused(of({.kind = PlotKind::bars, .x = {1, 2}, .y = {1, 2}}),
          "plot: series 1: expected 3 edges of bars, got 2");
  refused(of({.kind = PlotKind::bars, .x = {1, 3, 2}, .y = {1, 2}}),
          "plot: series 1: expected ascending edges, got 2 as number 3");
  refused(of({.x = {NAN}, .y = {1}}), "plot: expected at least one finite value, got none");
  Plot plot = of({.x = {0}, .y = {1}});
  plot.width = 10;
  refused(plot, "plot: expected a width of 64 to 8192 pixels, got 10");
  plot = of({.x = {0}, .y = {1}});
  plot.y.range = std::array{1.0, 1.0};
  refused(plot, "plot: y_range: expected a lower and a higher number, got 1 and 1");
  refused(of({.x = std::vector<double>(200'001), .y = std::vector<double>(200'001)}),
          "plot: expected at most 200000 values in all, got 200001");
}

TEST_CASE("a sheet contains complete pictures, each in its cell") {
  std::vector<Picture> pictures;
  for (int i = 0; i < 5; ++i) {
    Picture p{20 + i, 10, std::vector<uint8_t>(3 * static_cast<size_t>(20 + i) * 10)};
    std::ranges::fill(p.pixels, static_cast<uint8_t>(40 * i));
    pictures.push_back(p);
  }
  std::vector<const Picture*> list;
  for (const Picture& p : pictures) list.push_back(&p);
  const Picture sheet = contact_sheet(list, {.columns = 2, .gap = 4}, letters());
  CHECK(sheet.width == 4 + 2 * (24 + 4));
  CHECK(sheet.height == 4 + 3 * (10 + 4));
  for (int i = 0; i < 5; ++i) {
    const int found = static_cast<int>(std::ranges::count(sheet.pixels, 40 * i));
    CHECK(found == 3 * (20 + i) * 10);
  }
  const Picture told = contact_sheet(list, {.captions = {"a", "b", "c", "d", "e"}}, letters());
  CHECK(told.height > told.width / 4);
  // a caption of two lines makes the row higher for both pictures
  const Picture two = contact_sheet(list, {.captions = {"a", "b\nb", "c", "d", "e"}}, letters());
  CHECK(two.width == told.width);
  CHECK(two.height == told.height + 18 * ((told.height - 12) / (10 + 22 + 12)));
  // notes are below all pictures, with as many lines as required
  const Picture noted =
      contact_sheet(list, {.notes = {"a b", "c"}, .columns = 2, .gap = 4}, letters());
  CHECK(noted.height == sheet.height + 2 * 18 + 4 + (noted.height > sheet.height + 40 ? 18 : 0));
  CHECK(std::equal(sheet.pixels.begin(), sheet.pixels.end(), noted.pixels.begin()));
  CHECK(std::any_of(noted.pixels.begin() + static_cast<std::ptrdiff_t>(sheet.pixels.size()),
                    noted.pixels.end(), [](uint8_t level) { return level < 100; }));
  CHECK_THROWS_WITH_AS(contact_sheet({}, {}, letters()),
                       "sheet: expected at least one picture, got none", Error);
  CHECK_THROWS_WITH_AS(contact_sheet(list, {.captions = {"a"}}, letters()),
                       "sheet: expected 5 captions, one per picture, got 1", Error);
  CHECK_THROWS_WITH_AS(contact_sheet(list, {.gap = -1}, letters()),
                       "sheet: expected a gap of 0 to 1000 pixels, got -1", Error);
}
