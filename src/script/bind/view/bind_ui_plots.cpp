#include <optional>

#include "clench/script/bind/view/ui_frame.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/read.h"

namespace clench {

namespace {

// range and size of a plot
struct PlotRange {
  std::optional<double> low, high;
  double height;
  explicit PlotRange(Table& options) : height(options.number("height", 80)) {
    if (options.has("min")) low = options.number("min");
    if (options.has("max")) high = options.number("max");
  }
};

int ui_plot(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const std::vector<double> values = check_numbers(L, 3, "values");
  Table options(L, 4);
  const PlotRange range(options);
  options.done();
  gui.plot(label, values, range.low, range.high, range.height);
  return 0;
}

int ui_curves(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const std::vector<std::vector<double>> values = read_rows(L, 3, {L, {}, "values"}, -1);
  Table options(L, 4);
  const PlotRange range(options);
  std::vector<Rgba> colors;
  if (options.has("colors"))
    for (const std::vector<double>& c : options.rows("colors", 3))
      colors.push_back(
          {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]), 1});
  options.done();
  gui.curves(label, values, colors, range.low, range.high, range.height);
  return 0;
}

}  // namespace

static const Entry ui_plot_methods[] = {
    {"plot", guarded<ui_plot>, R"(
A curve of numbers.
@param label string  text beside it
@param values number[]  at equal distances
@param options? table  range and size
@option min? number  lower end, by default the smallest value
@option max? number  upper end, by default the largest value
@option height? number [pixels] = 80  height
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:plot("p", {1, 2, 3}, {height = 30}) end) end)
> ui.items[#ui.items].kind  --> plot)"},
    {"curves", guarded<ui_curves>, R"(
Several curves of numbers over one range.
@param label string  identifies it
@param values number[][]  of each curve, at equal distances
@param options? table  range and look
@option min? number  lower end, by default the smallest value
@option max? number  upper end, by default the largest value
@option height? number [pixels] = 80  height
@option colors? number[][]  of each curve, red, green and blue, 0 to 1; by default that of a plot
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:curves("c", {{1, 2, 3}, {3, 1}}, {height = 30}) end) end)
> ui.items[#ui.items].height  --> 30.0)"},
};

const Class ui_plots_class{.name = "ui_plots",
                           .variable = "ui",
                           .doc = "Curves of numbers in a user interface.",
                           .methods = ui_plot_methods,
                           .parent = &ui_containers_class};

}  // namespace clench
