#include <doctest/doctest.h>
#include <tinyxml2.h>

#include <cmath>
#include <sstream>

#include "clench/render/figure/canvas.h"
#include "clench/render/figure/chart.h"
#include "clench/render/figure/plot.h"
#include "letters.h"

using namespace clench;
using clench::test::letters;
using Eigen::Vector2f;

namespace {

Drawing a_chart() {
  return draw_chart({.title = "Zwei <Hände> & eine",
                     .labels = {"Barrett", "Shadow"},
                     .series = {{"epsilon", {0.25, NAN}}, {"effort [N]", {-3, 1}, false}}},
                    {.width = 400, .height = 300}, letters());
}

Drawing a_plot() {
  Plot plot;
  plot.title = "grasps";
  plot.y.label = "found [1]";
  plot.categories = {"a long name of a hand, upright", "b", "c", "d", "e", "f", "g", "h"};
  plot.series = {{.name = "random", .kind = PlotKind::bars, .y = {1, 2, 3, 4, 5, -1, 2, 3}},
                 {.name = "antipodal", .kind = PlotKind::bars, .y = {2, 2, 2, 2, 2, 2, 2, 2}},
                 {.name = "mean", .y = {1, 2, 1, 2, 1, 2, 1, 2}}};
  return draw_plot(plot, letters());
}

Vector2f place(const tinyxml2::XMLElement* e, const char* x = "x", const char* y = "y") {
  return {e->FloatAttribute(x, NAN), e->FloatAttribute(y, NAN)};
}

// compares every item with the next element, to the hundredth of a pixel of the file
void compare(const Drawing& drawing) {
  tinyxml2::XMLDocument svg;
  REQUIRE(svg.Parse(svg_text(drawing).c_str()) == tinyxml2::XML_SUCCESS);
  const auto* root = svg.RootElement();
  REQUIRE(root->Name() == std::string("svg"));
  CHECK(root->IntAttribute("width") == drawing.width);
  CHECK(root->IntAttribute("height") == drawing.height);
  const auto* e = root->FirstChildElement()->NextSiblingElement();  // after the white background
  const auto close = [](const Vector2f& a, const Vector2f& b) {
    CHECK((a - b).cwiseAbs().maxCoeff() < 0.011f);
  };
  for (const Drawing::Item& item : drawing.items) {
    REQUIRE(e);
    const std::string name = e->Name();
    if (const auto* area = std::get_if<Drawing::Area>(&item)) {
      REQUIRE(name == "rect");
      close(place(e), area->low);
      close(place(e, "width", "height"), area->high - area->low);
    } else if (const auto* text = std::get_if<Drawing::Text>(&item)) {
      REQUIRE(name == "text");
      close(place(e), text->at);
      CHECK(e->GetText() == text->text);
      CHECK((e->Attribute("transform") != nullptr) == text->upright);
      CHECK((e->Attribute("paint-order") != nullptr) == text->rim);
    } else {
      const auto& line = std::get<Drawing::Line>(item);
      if (line.points.size() == 1) {
        REQUIRE(name == "circle");
        close(place(e, "cx", "cy"), line.points[0]);
      } else {
        REQUIRE(name == "polyline");
        std::istringstream points(e->Attribute("points"));
        for (const Vector2f& p : line.points) {
          Vector2f q(NAN, NAN);
          char comma = 0;
          points >> q.x() >> comma >> q.y();
          close(q, p);
        }
      }
    }
    e = e->NextSiblingElement();
  }
  CHECK(!e);
}

std::vector<Drawing::Area> bars_of(const Drawing& drawing) {
  std::vector<Drawing::Area> out;
  for (const auto& item : drawing.items)
    if (const auto* area = std::get_if<Drawing::Area>(&item)) out.push_back(*area);
  return out;
}

const Drawing::Text& text_in(const Drawing& drawing, const std::string& beginning) {
  for (const auto& item : drawing.items)
    if (const auto* text = std::get_if<Drawing::Text>(&item))
      if (text->text.starts_with(beginning)) return *text;
  throw std::runtime_error("no text " + beginning);
}

}  // namespace

TEST_CASE("a chart and a plot in SVG have every part at the same position as in the picture") {
  compare(a_chart());
  compare(a_plot());
}

TEST_CASE("the picture shows each filled area of the drawing in the area's color") {
  for (const Drawing& drawing : {a_chart(), a_plot()}) {
    const Picture picture = paint(drawing, letters());
    int compared = 0;
    for (const Drawing::Area& area : bars_of(drawing)) {
      if ((area.high - area.low).minCoeff() < 8) continue;
      // near a lower corner, which no text or line covers
      const Vector2f at(area.low.x() + 3, area.low.y() + 3);
      const auto* pixel = &picture.pixels[3 * (static_cast<size_t>(at.y()) * picture.width +
                                               static_cast<size_t>(at.x()))];
      for (int k = 0; k < 3; ++k) compared += std::abs(pixel[k] - 255 * area.color[k]) < 1.5f;
    }
    CHECK(compared >= 6);
  }
}

TEST_CASE(
    "bars of a category stand side by side around its name, with the heights of their values") {
  Plot plot;
  plot.categories = {"one", "two", "three"};
  plot.series = {{.kind = PlotKind::bars, .y = {1, 2, 4}},
                 {.kind = PlotKind::bars, .y = {2, NAN, -1}}};
  plot.y.range = {-2, 5};
  const Drawing drawing = draw_plot(plot, letters());
  const auto bars = bars_of(drawing);
  REQUIRE(bars.size() == 5);
  const float zero = bars[0].high.y(), unit = zero - bars[0].low.y();
  const auto width = [](const Drawing::Area& bar) { return bar.high.x() - bar.low.x(); };
  for (const auto& bar : bars) CHECK(width(bar) == doctest::Approx(width(bars[0])).epsilon(1e-3));
  CHECK(zero - bars[1].low.y() == doctest::Approx(2 * unit).epsilon(1e-3));
  CHECK(zero - bars[2].low.y() == doctest::Approx(4 * unit).epsilon(1e-3));
  CHECK(zero - bars[3].low.y() == doctest::Approx(2 * unit).epsilon(1e-3));
  CHECK(bars[4].low.y() == doctest::Approx(zero).epsilon(1e-5));
  CHECK(bars[4].high.y() - zero == doctest::Approx(unit).epsilon(1e-3));
  // the first category: bars 0 and 3 touch at its center, above its name
  const float middle = (bars[0].high.x() + bars[3].low.x()) / 2;
  CHECK(bars[3].low.x() - bars[0].high.x() == doctest::Approx(1).epsilon(1e-2));
  const auto& name = text_in(drawing, "one");
  CHECK(name.at.x() + letters().width("one", name.height) / 2 ==
        doctest::Approx(middle).epsilon(1e-3));
  CHECK(!name.upright);
  // categories are evenly spaced
  CHECK(bars[1].low.x() - bars[0].low.x() ==
        doctest::Approx(bars[2].low.x() - bars[1].low.x()).epsilon(1e-3));
}

TEST_CASE("names of narrow categories are upright and stay within the figure") {
  const Drawing drawing = a_plot();
  const auto& name = text_in(drawing, "b");
  CHECK(name.upright);
  for (const auto& item : drawing.items)
    if (const auto* text = std::get_if<Drawing::Text>(&item)) {
      const float width = letters().width(text->text, text->height);
      const Vector2f end = text->at + (text->upright ? Vector2f(0, -width) : Vector2f(width, 0));
      for (const Vector2f& p : {text->at, end})
        CHECK((p.x() >= 0 && p.y() >= 0 && p.x() <= 720 && p.y() <= 480));
    }
}

TEST_CASE("data that do not fit the categories are rejected in one sentence") {
  const auto refused = [](const PlotSeries& series, const char* sentence, PlotAxis x = {}) {
    Plot plot;
    plot.categories = {"a", "b"};
    plot.series = {series};
    plot.x = x;
    CHECK_THROWS_WITH(draw_plot(plot, letters()), sentence);
  };
  refused({.name = "n", .y = {1}}, "plot: series 'n': expected 2 values, one per category, got 1");
  refused({.x = {1, 2}, .y = {1, 2}},
          "plot: series 1: expected no x, because categories are along that axis");
  refused({.y = {1, 2}}, "plot: x_range: not allowed with categories", {.range = {{0, 1}}});
  refused({.y = {1, 2}}, "plot: x_scale: not allowed with categories", {.logarithmic = true});
}
