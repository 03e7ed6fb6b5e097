#include <list>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/render/figure/plot.h"
#include "clench/render/figure/sheet.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

// numbers, or false for missing ones
static std::vector<double> read_gappy(lua_State* L, Table& series, const char* key) {
  std::vector<double> out;
  series.each(key, "a list of numbers", [&](int i, const What& what) {
    const bool none = lua_isboolean(L, i) && !lua_toboolean(L, i);
    if (!none && lua_type(L, i) != LUA_TNUMBER) fail_expected(what, "a number, or false", i);
    out.push_back(none ? NAN : lua_tonumber(L, i));
  });
  return out;
}

// a list of texts; empty if absent
static std::vector<std::string> read_texts(lua_State* L, Table& options, const char* key) {
  std::vector<std::string> out;
  if (!options.has(key)) return out;
  options.each(key, "a list of texts",
               [&](int i, const What& what) { out.push_back(read_string(L, i, what)); });
  if (out.empty()) fail("{}: expected at least one, got none", options.what(key).text());
  return out;
}

// categories: are there names along x?
static PlotSeries read_plot_series(lua_State* L, int index, const What& what, bool categories) {
  if (!lua_istable(L, index)) fail_expected(what, "{x = ..., y = ...}", index);
  Table one(L, index, what.text());
  PlotSeries series;
  series.name = one.string("name", "");
  if (one.has("edges")) {
    // the result of clench.stats.histogram
    series.kind = PlotKind::bars;
    series.x = one.numbers("edges");
    series.y = one.numbers("counts");
    one.number("below", 0), one.number("above", 0);
  } else {
    series.kind = one.choice(
        "kind", {{"line", PlotKind::line}, {"points", PlotKind::points}, {"bars", PlotKind::bars}},
        categories ? PlotKind::bars : PlotKind::line);
    series.y = read_gappy(L, one, "y");
    if (one.has("x"))
      series.x = read_gappy(L, one, "x");
    else if (!categories)
      for (size_t i = 1; i <= series.y.size(); ++i) series.x.push_back(static_cast<double>(i));
  }
  one.done();
  return series;
}

static PlotAxis read_axis(Table& options, const char* label, const char* range, const char* scale) {
  PlotAxis axis{options.string(label, "")};
  axis.logarithmic = options.choice(scale, {{"linear", false}, {"log", true}}, false);
  if (!options.has(range)) return axis;
  const auto ends = options.numbers(range, 2);
  axis.range = std::array{ends[0], ends[1]};
  return axis;
}

static int make_plot(lua_State* L) {
  Table options(L, 1);
  Plot plot;
  plot.title = options.string("title", "");
  plot.x = read_axis(options, "x_label", "x_range", "x_scale");
  plot.y = read_axis(options, "y_label", "y_range", "y_scale");
  plot.width = options.integer("width", plot.width);
  plot.height = options.integer("height", plot.height);
  plot.categories = read_texts(L, options, "categories");
  options.each("series", "a list of series", [&](int i, const What& what) {
    plot.series.push_back(read_plot_series(L, i, what, !plot.categories.empty()));
  });
  options.done();
  const Font font;
  warn_without_letters(L, font);
  return push_object(L, PlotHandle{std::make_shared<const Drawing>(draw_plot(plot, font))});
}

static int plot_save(lua_State* L) {
  const auto& plot = self<PlotHandle>(L);
  const std::string path = check_output(L, 2);
  if (path.ends_with(".svg"))
    write_file(path, svg_text(*plot.drawing));
  else if (path.ends_with(".png"))
    save_png(paint(*plot.drawing, Font()), path);
  else
    fail("{}: expected a name that ends in .svg or .png, got {}", subject(L), in_quotes(path));
  return 0;
}

static bool operator==(const PlotHandle& a, const PlotHandle& b) {
  return svg_text(*a.drawing) == svg_text(*b.drawing);
}

static std::string plot_text(const PlotHandle& plot) {
  return fmt::format("plot of {} x {} pixels", plot.drawing->width, plot.drawing->height);
}

static int make_sheet(lua_State* L) {
  Table options(L, 1);
  const Font font;
  SheetOptions arranging;
  std::vector<const Picture*> pictures;
  std::list<Picture> painted;  // of plots
  options.each("pictures", "a list of pictures", [&](int i, const What& what) {
    if (const auto* plot = to<PlotHandle>(L, i)) {
      pictures.push_back(&painted.emplace_back(paint(*plot->drawing, font)));
      return;
    }
    const auto* picture = to<Picture>(L, i);
    if (!picture) fail_object(what, class_of<Picture>(), i);
    pictures.push_back(picture);  // the list keeps it alive
  });
  arranging.captions = read_texts(L, options, "captions");
  arranging.notes = read_texts(L, options, "notes");
  arranging.columns = options.integer("columns", arranging.columns);
  arranging.gap = options.integer("gap", arranging.gap);
  options.done();
  if (!arranging.captions.empty() || !arranging.notes.empty()) warn_without_letters(L, font);
  return push_object(L, contact_sheet(pictures, arranging, font));
}

static const Entry plot_functions[] = {
    {"plot", guarded<make_plot>, R"(
Plots numbers over numbers: lines, points, and bars between edges, such as those of clench.stats.histogram; with `categories`, numbers
over names, as bars next to each other. `false` and values that are not finite are left out, and leave a gap in a line. Color-blind people can distinguish the colors. No
graphics hardware is needed.
@param options table  the series and the axes
@option series table[]  one table of these fields each
@option series.name? string  shown in a legend
@option series.kind? "line"|"points"|"bars"  by default a line, of categories bars
@option series.x? (number|false)[]  1, 2, 3 ... by default; of bars their edges, one more than y
@option series.y? (number|false)[]  values; false: none
@option series.edges? number[]  edges of bars, as of clench.stats.histogram
@option series.counts? number[]  heights of bars, as of clench.stats.histogram
@option series.below? number  of clench.stats.histogram, not drawn
@option series.above? number  of clench.stats.histogram, not drawn
@option categories? string[]  names along x: every series has one y for each, and no x
@option title? string  above the plot
@option x_label? string  with its unit
@option y_label? string  with its unit
@option x_range? number[]  {low, high}; what lies outside is cut off
@option y_range? number[]  {low, high}; what lies outside is cut off
@option x_scale? "linear"|"log" = "linear"  log leaves out what is not > 0
@option y_scale? "linear"|"log" = "linear"  log leaves out what is not > 0
@option width? integer [pixels, 64 to 8192] = 720  width
@option height? integer [pixels, 64 to 8192] = 480  height
@return plot
@effect reads
> p = clench.plot{series = {{name = "epsilon", x = {0, 1, 2}, y = {0.1, 0.3, 0.2}}}, x_label = "angle [rad]"}
> p  --> plot of 720 x 480 pixels
> clench.plot{series = {clench.stats.histogram{1, 2, 2, 3}}}.picture  --> picture of 720 x 480 pixels
> clench.plot{series = {{x = {1, 10, 100}, y = {1, 4, 9}}}, x_scale = "log"}  --> plot of 720 x 480 pixels
> clench.plot{categories = {"Barrett", "Shadow"}, series = {{name = "random", y = {12, 7}}, {name = "antipodal", y = {30, 21}}}, y_label = "grasps"}  --> plot of 720 x 480 pixels
> clench.plot{series = {{y = {1, 2}}}, y_scale = "log", y_range = {0, 1}}  --> error: y_range: expected numbers > 0 on a logarithmic axis, got 0 and 1
> clench.plot{series = {{x = {1, 2}, y = {1}}}}  --> error: series 1: expected 1 values of x, as there are of y, got 2)"},
    {"sheet", guarded<make_sheet>, R"(
Several pictures in one, in rows, each with its caption below it, and notes at the bottom.
@param options table  the pictures and their texts
@option pictures (picture|plot)[]  from left to right, and down
@option captions? string[]  one per picture, of one or more lines
@option notes? string[]  lines of text below, broken where they are too wide
@option columns? integer [1 to 16384]  so many that the sheet is about square, by default
@option gap? integer [pixels, 0 to 1000] = 12  between pictures
@return picture
@effect reads
> small = clench.render(world, {size = {64, 48}})
> clench.sheet{pictures = {small, small, small}, captions = {"a", "b", "c"}, columns = 3, gap = 4}  --> picture of 208 x 78 pixels
> clench.sheet{pictures = {}}  --> error: expected at least one picture, got none)"},
};

static const Entry plot_fields[] = {
    {"picture", getter<[](const PlotHandle& x) { return paint(*x.drawing, Font()); }>, R"(
The figure as pixels, on white.
@type picture
> clench.plot{series = {{y = {1, 2}}}, width = 100, height = 80}.picture.width  --> 100)"},
    {"width", getter<[](const PlotHandle& x) { return x.drawing->width; }>, R"(
Its width [pixels].
@type integer
> clench.plot{series = {{y = {1, 2}}}}.width  --> 720)"},
    {"height", getter<[](const PlotHandle& x) { return x.drawing->height; }>, R"(
Its height [pixels].
@type integer
> clench.plot{series = {{y = {1, 2}}}}.height  --> 480)"},
};

static const Entry plot_methods[] = {
    {"save", guarded<plot_save>, R"(
Writes a file: .svg, whose lines and letters drawing programs can edit, or .png.
@param path string  file to write, .svg or .png
@effect files
> clench.plot{series = {{y = {1, 2}}}}:save "build/line.svg"
> clench.plot{series = {{y = {1, 2}}}}:save "line.pdf"  --> error: expected a name that ends in .svg or .png, got 'line.pdf')"},
};

static const Entry plot_operators[] = {{"__tostring", method<plot_text>, ""},
                                       {"__eq", equality<PlotHandle>, ""}};

const Library plot_library{.name = "clench", .doc = "", .functions = plot_functions};

const Class plot_class{.name = "plot",
                       .variable = "plot",
                       .doc =
                           "Numbers as a figure, made by `clench.plot` or `clench.chart`. Two with "
                           "the same contents are equal.",
                       .fields = plot_fields,
                       .methods = plot_methods,
                       .operators = plot_operators};

}  // namespace clench
