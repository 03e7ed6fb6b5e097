#include <ranges>

#include "clench/render/figure/chart.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

static constexpr size_t max_named = 8;  // number of characters drawn as boxes

static ChartSeries read_series(lua_State* L, int index, const What& what) {
  if (!lua_istable(L, index)) fail_expected(what, "{name = ..., values = ...}", index);
  Table one(L, index, what.text());
  ChartSeries series;
  series.name = one.string("name");
  series.higher_is_better = one.boolean("higher_is_better", true);
  one.each("values", "a list", [&](int i, const What& value) {
    const bool none = lua_isboolean(L, i) && !lua_toboolean(L, i);
    series.values.push_back(none ? NAN : read_number(L, i, value));
  });
  one.done();
  return series;
}

// once per chart, by their code points
static void warn_of_boxes(lua_State* L, const Chart& chart, const Font& font) {
  std::string all = chart.title;
  for (const std::string& label : chart.labels) all += ' ' + label;
  for (const ChartSeries& series : chart.series) all += ' ' + series.name;
  const std::set<char32_t> boxes = font.missing(all);
  if (boxes.empty()) return;
  std::string names;
  for (const char32_t letter : boxes | std::views::take(max_named))
    names += fmt::format("{}U+{:04X}", names.empty() ? "" : ", ", static_cast<uint32_t>(letter));
  if (boxes.size() > max_named) names += fmt::format(" and {} more", boxes.size() - max_named);
  log_warning(L, "chart: these characters are drawn as boxes: " + names);
}

static int chart_draw(lua_State* L) {
  Table options(L, 1);
  Chart chart;
  chart.title = options.string("title", "");
  if (options.has("labels"))
    options.each("labels", "a list",
                 [&](int i, const What& what) { chart.labels.push_back(read_string(L, i, what)); });
  options.each("series", "a list",
               [&](int i, const What& what) { chart.series.push_back(read_series(L, i, what)); });
  ChartOptions drawing;
  drawing.width = options.integer("width", drawing.width);
  drawing.height = options.integer("height", drawing.height);
  options.done();
  const Font font;
  warn_without_letters(L, font);
  warn_of_boxes(L, chart, font);
  return push_object(L,
                     PlotHandle{std::make_shared<const Drawing>(draw_chart(chart, drawing, font))});
}

static const Entry chart_functions[] = {
    {"chart", guarded<chart_draw>, R"(
Draws numbers as columns: one panel per series, each with its own scale, all over the same items, with the value at each column if
it fits. The best column of a panel, the largest unless higher_is_better is false, is the darkest. `false` is a missing
value, and marked. Texts are UTF-8; characters that the font lacks are drawn as boxes, and a warning names them. Texts
that are too long are shortened in the middle. No graphics hardware is needed.
@param options table  the series and their labels
@option series table[]  one table of these fields each
@option series.name string  of the panel
@option series.values (number|false)[]  one per item; false: none
@option series.higher_is_better? boolean = true  false: the lowest value is the best
@option labels? string[]  one per item, their numbers by default
@option title? string  above the chart
@option width? integer [pixels, 64 to 8192] = 960  width
@option height? integer [pixels]  64 to 8192, by default as high as the panels need
@return plot  to be saved as PNG or SVG
@effect reads
> clench.chart{series = {{name = "epsilon", values = {0.1, 0.3, 0.2}}}, height = 200}  --> plot of 960 x 200 pixels
> clench.chart{series = {}}  --> error: expected at least one series)"},
};

const Library chart_library{.name = "clench", .doc = "", .functions = chart_functions};

}  // namespace clench
