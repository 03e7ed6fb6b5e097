#include "clench/render/figure/chart.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/render/figure/canvas.h"
#include "letters.h"

using namespace clench;
using clench::test::letters;
using Eigen::Vector2f;

namespace {

Picture painted(const Chart& chart, const ChartOptions& options = {}) {
  return paint(draw_chart(chart, options), letters());
}

const Canvas::Color black(0, 0, 0);

int ink_of(const Picture& picture) {
  int sum = 0;
  for (size_t i = 0; i < picture.pixels.size(); i += 3) sum += 255 - picture.pixels[i];
  return sum;
}

}  // namespace

TEST_CASE("the ink of a line is its area, at any position and direction") {
  for (const Vector2f& along : {Vector2f(40, 0), Vector2f(0, 40), Vector2f(24, 32)}) {
    Picture picture = blank_picture(100, 100);
    Canvas(picture, letters()).line({20.3f, 25.7f}, Vector2f(20.3f, 25.7f) + along, 3, black);
    // 40 x 3 and two half discs; 3 % tolerance, because edges are blended by distance
    CHECK(ink_of(picture) / 255.0 == doctest::Approx(40 * 3 + M_PI * 1.5 * 1.5).epsilon(0.03));
  }
}

TEST_CASE("the ink of a rectangle is its area up to the rounding of bytes, clipped at the edges") {
  Picture picture = blank_picture(50, 40);
  Canvas canvas(picture, letters());
  canvas.rectangle({10.25f, 5.5f}, {20.5f, 15.75f}, black);
  CHECK(ink_of(picture) / 255.0 == doctest::Approx(10.25 * 10.25).epsilon(0.002));
  canvas.rectangle({-1e9f, -1e9f}, {1e9f, 1e9f}, black);
  CHECK(ink_of(picture) == 255 * 50 * 40);
  canvas.line({-1e6f, 3}, {-1e5f, 3}, 2, Canvas::Color(1, 1, 1));
  CHECK(ink_of(picture) == 255 * 50 * 40);
}

TEST_CASE("text runs along its direction and has the reported width") {
  const float height = 12, width = letters().width("epsilon", height);
  Picture level = blank_picture(200, 200), upright = blank_picture(200, 200);
  Canvas(level, letters()).text({"epsilon", {50, 100}, height}, black);
  Canvas(upright, letters()).text({"epsilon", {100, 150}, height, -Vector2f::UnitY()}, black);
  // the second is the first, rotated by a quarter turn
  CHECK(ink_of(level) == doctest::Approx(ink_of(upright)).epsilon(0.01));
  const auto inside = [&](const Picture& p, int x0, int y0, int x1, int y1) {
    int sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += 255 - p.pixels[3 * (200 * static_cast<size_t>(y) + x)];
    return sum;
  };
  const int room = static_cast<int>(width) + 1;
  CHECK(inside(level, 50, 84, 50 + room, 106) == ink_of(level));
  CHECK(inside(upright, 84, 150 - room, 106, 150) == ink_of(upright));
}

TEST_CASE("an axis spans all values and zero in 2 to 5 steps of 1, 2 or 5") {
  for (const auto& values : {std::vector<double>{0.0876},
                             {-3, 7},
                             {1e-9, 2e-9},
                             {-1e300, 1e308},
                             {1e308, -1e308},
                             {42, NAN, INFINITY},
                             {-0.001}}) {
    const ChartAxis axis = chart_axis(values);
    CHECK(std::isfinite(axis.low));
    CHECK(std::isfinite(axis.high));
    CHECK(axis.low <= 0);
    CHECK(axis.high >= 0);
    for (const double value : values)
      if (std::isfinite(value)) CHECK((axis.low <= value && value <= axis.high));
    const double steps = axis.high / axis.step - axis.low / axis.step;
    CHECK(steps >= 2);
    CHECK(steps <= 6);
  }
  CHECK(chart_axis({0, 0, NAN}).high == 1);
  CHECK(chart_axis({5e-324}).high == 1);
}

TEST_CASE("a chart is as high as its panels require, and byte-identical every time") {
  const Chart chart{.title = "two grasps",
                    .labels = {"one", "two"},
                    .series = {{"epsilon", {0.1, 0.2}}, {"volume", {NAN, -3}}}};
  const Picture picture = painted(chart);
  CHECK(picture.width == 960);
  CHECK(picture.height > 300);
  CHECK(picture.pixels == painted(chart).pixels);
  Chart third = chart;
  third.series.push_back({"rank", {6, 6}});
  CHECK(painted(third).height > picture.height);
  CHECK(painted(chart, {.width = 64, .height = 64}).pixels.size() == 3 * 64 * 64);
}

TEST_CASE("higher columns have more ink, and the best one is the darkest") {
  const auto ink = [](std::vector<double> values) {
    return ink_of(painted({.series = {{"x", std::move(values)}}}, {.width = 400, .height = 200}));
  };
  CHECK(ink({1, 1}) > ink({1, 0.5}));
  CHECK(ink({1, 0.5}) > ink({1, 0}));
}

TEST_CASE("zero, small values and a panel of zeros look different") {
  const auto drawn = [](std::vector<double> values) {
    return painted({.series = {{"x", std::move(values)}}}, {.width = 400, .height = 200}).pixels;
  };
  CHECK(drawn({1, 0}) != drawn({1, 1e-9}));
  CHECK(drawn({1, 1e-9}) != drawn({1, -1e-9}));
  CHECK(drawn({0, 0}) != drawn({1, 1}));
  // only the line of zero: less ink than with the lines of other values
  CHECK(ink_of(painted({.series = {{"x", {0, 0}}}}, {.width = 400, .height = 200})) <
        ink_of(painted({.series = {{"x", {1e-300, 0}}}}, {.width = 400, .height = 200})));
}

TEST_CASE("if small values are better, the lowest column is the darkest") {
  Chart chart{.series = {{"effort", {3, 1}}}};
  const Picture largest = painted(chart, {.width = 400, .height = 200});
  chart.series[0].higher_is_better = false;
  // now the darker column is the smaller one
  CHECK(ink_of(painted(chart, {.width = 400, .height = 200})) < ink_of(largest));
}

TEST_CASE("in wide columns a long label does not increase the height of a chart") {
  const auto height = [](std::string label, size_t items) {
    Chart chart{.labels = std::vector<std::string>(items, "a"),
                .series = {{"x", std::vector<double>(items, 1)}}};
    chart.labels[0] = std::move(label);
    return painted(chart).height;
  };
  CHECK(height(std::string(300, 'y'), 4) == height("a", 4));
  // upright labels of narrow columns have at most 16 letters
  CHECK(height(std::string(300, 'y'), 40) <= height("a", 40) + 150);
  CHECK(height(std::string(300, 'y'), 40) > height("a", 40));
}

TEST_CASE("shortened labels that differ only in the middle stay distinguishable") {
  const std::string front(60, 'a'), back(60, 'b');
  const auto drawn = [&](std::string first, std::string second, size_t items) {
    Chart chart{.labels = std::vector<std::string>(items, front + "3" + back),
                .series = {{"x", std::vector<double>(items, 1)}}};
    chart.labels[0] = front + first + back;
    chart.labels[1] = front + second + back;
    return painted(chart).pixels;
  };
  for (const size_t items : {3, 40}) {
    CHECK(drawn("1", "2", items) != drawn("2", "1", items));
    CHECK(drawn("1", "2", items) == drawn("1", "2", items));
  }
  // equal labels, a single one, and one that is the beginning of another
  CHECK(drawn("3", "3", 3).size() == drawn("1", "2", 3).size());
  CHECK(painted({.labels = {front + back}, .series = {{"x", {1}}}}, {.width = 200}).width == 200);
  CHECK(painted({.labels = {front, front + front}, .series = {{"x", {1, 2}}}}).width == 960);
}

TEST_CASE("low panels draw only within themselves") {
  // the area below the last of three panels is as empty as the margin
  const Chart chart{.labels = {" ", " "}, .series = {{"x", {1, -1}}, {"y", {1, 2}}, {"z", {3, 4}}}};
  for (const int height : {80, 120, 200}) {
    const Picture picture = painted(chart, {.width = 300, .height = height});
    int below = 0;
    for (int y = height - 16; y < height; ++y)
      for (int x = 0; x < 300; ++x)
        below += 255 - picture.pixels[3 * (300 * static_cast<size_t>(y) + x)];
    CHECK(below == 0);
  }
}

TEST_CASE("a chart with inconsistent counts is rejected in one sentence") {
  const auto refused = [](const Chart& chart, const char* sentence, ChartOptions options = {}) {
    CHECK_THROWS_WITH_AS(draw_chart(chart, options), sentence, Error);
  };
  refused({}, "chart: expected at least one series, got none");
  refused({.series = {{"a", {}}}}, "chart: series 'a': expected at least one value, got none");
  refused({.series = {{"a", {1, 2}}, {"b", {1}}}},
          "chart: series 'b': expected 2 values as in the first, got 1");
  refused({.labels = {"x"}, .series = {{"a", {1, 2}}}},
          "chart: expected 2 labels, one per value, got 1");
  refused({.labels = {"x", "y"}, .series = {{"a", {1}}}},
          "chart: expected 1 label, one per value, got 2");
  refused({.series = {{"a", {1}}}}, "chart: expected a width of 64 to 8192 pixels, got 63",
          {.width = 63});
  refused({.series = {{"a", {1}}}}, "chart: expected a height of 64 to 8192 pixels, got 9000",
          {.height = 9000});
}

TEST_CASE("numbers of any size make a chart") {
  const double largest = std::numeric_limits<double>::max();
  for (const auto& values : {std::vector<double>{1e308, -1e308},
                             {largest, -largest},
                             {largest},
                             {-largest, 1},
                             {2e307, 5e-324},
                             {1e-300, -1e-300}})
    for (const int size : {64, 300}) {
      const Picture picture = painted({.series = {{"x", values}}}, {.width = size, .height = size});
      CHECK(ink_of(picture) > 0);
    }
  const ChartAxis axis = chart_axis({largest, -largest});
  CHECK(axis.low == -largest);
  CHECK(axis.high == largest);
}

TEST_CASE("the numbers of values and letters of a chart are limited") {
  CHECK_THROWS_WITH_AS(draw_chart({.series = {{"x", std::vector<double>(10000, 1)}}}),
                       "chart: expected at most 8192 values per series, got 10000", Error);
  CHECK_THROWS_WITH_AS(
      draw_chart({.series = std::vector<ChartSeries>(200, {"x", std::vector<double>(8000, 1)})}),
      "chart: expected at most 1000000 values in all, got 200 series of 8000", Error);
  CHECK_THROWS_WITH_AS(draw_chart({.title = std::string(10'000'000, 'x'), .series = {{"x", {1}}}}),
                       "chart: expected texts of at most 10000000 bytes in all, got 10000001",
                       Error);
}
