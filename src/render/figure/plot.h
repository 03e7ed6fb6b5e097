// Plots of numbers over numbers or over categories: lines, points, histograms and bars, over axes
// with their own scales.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "clench/render/figure/drawing.h"

namespace clench {

enum class PlotKind { line, points, bars };

struct PlotSeries {
  std::string name = {};  ///< name in the legend; empty: it is not listed
  PlotKind kind = PlotKind::line;
  /// values that are not finite are left out, and leave a gap in a line; for bars, x holds their
  /// edges, ascending, one more than y
  std::vector<double> x = {}, y = {};
};

struct PlotAxis {
  std::string label = {};  ///< including its unit
  std::optional<std::array<double, 2>> range =
      {};  ///< drawing is clipped to this range; absent: the range of all values
  /// values that are not > 0 are left out; not allowed for the heights of bars
  bool logarithmic = false;
};

struct Plot {
  std::string title = {};
  PlotAxis x, y;
  /// Category names along x, in place of numbers: each series has one value of y per category and
  /// no x, and bars of several series are drawn next to each other.
  std::vector<std::string> categories = {};
  std::vector<PlotSeries> series = {};
  int width = 720, height = 480;  ///< pixels, 64..8192
};

/// Axes have lines at multiples of 1, 2 or 5 times a power of ten; logarithmic axes have them at
/// powers of ten and, if these are few, at 2 and 5 times them. The y axis includes 0 if there are
/// bars. Names of categories that do not fit are drawn upright or shortened in the middle. Colors
/// are those of Okabe and Ito (2008), which color-blind people can distinguish. It needs no
/// graphics hardware.
/// throws  Error if there are no series or no finite numbers, if there are too many values, if
///         counts differ, or if a size or range is invalid, or not > 0 on a logarithmic axis
Drawing draw_plot(const Plot& plot, const Font& font);

}  // namespace clench
