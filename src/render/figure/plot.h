// Numbers over numbers or over names as a figure: lines, points, histograms and bars over axes with
// their own scales.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "clench/render/figure/drawing.h"

namespace clench {

enum class PlotKind { line, points, bars };

struct PlotSeries {
  std::string name = {};  ///< in the legend; empty: it has no place there
  PlotKind kind = PlotKind::line;
  /// what is not finite is left out, and a line has a gap there; of bars, x are their edges,
  /// ascending, one more than y
  std::vector<double> x = {}, y = {};
};

struct PlotAxis {
  std::string label = {};  ///< with its unit
  std::optional<std::array<double, 2>> range =
      {};                    ///< what lies outside is cut off; absent: all is shown
  bool logarithmic = false;  ///< values that are not > 0 are left out; not for the heights of bars
};

struct Plot {
  std::string title = {};
  PlotAxis x, y;
  /// Names along x, in place of its numbers: each series has one value of y per category and no x,
  /// and bars of several series stand beside one another.
  std::vector<std::string> categories = {};
  std::vector<PlotSeries> series = {};
  int width = 720, height = 480;  ///< pixels, 64..8192
};

/// Axes have lines at multiples of 1, 2 or 5 times a power of ten, logarithmic ones at powers of
/// ten and, where these are few, at 2 and 5 times them; that of y holds 0 where there are bars.
/// Names of categories that do not fit are upright or lose their middle.
/// Colors are those of Okabe and Ito (2008), which color-blind people tell apart. It needs no
/// graphics hardware.
/// throws  Error without series, where counts differ, with no finite number, with more than anybody
///         can see, and on a size or range out of order, or not > 0 on a logarithmic axis
Drawing draw_plot(const Plot& plot, const Font& font);

}  // namespace clench
