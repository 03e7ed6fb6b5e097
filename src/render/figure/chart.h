// Columns of numbers as a figure: one panel per series, one column per item, all over one axis.
#pragma once
#include <string>
#include <vector>

#include "clench/render/figure/drawing.h"

namespace clench {

struct ChartSeries {
  std::string name;            ///< with its unit
  std::vector<double> values;  ///< one per item; what is not finite is marked by a cross
  bool higher_is_better = true;
};

struct Chart {
  std::string title = {};
  std::vector<std::string> labels = {};  ///< one per item; empty: their numbers, from 1
  std::vector<ChartSeries> series = {};
};

struct ChartOptions {
  int width = 960, height = 0;  ///< pixels, 64..8192; a height of 0 is what the panels need
};

/// Each panel has its own scale, which begins at 0, or below where values are negative; its best
/// value is the darkest column, and values stand at the columns where they fit. Texts are UTF-8;
/// long ones lose their middle. It needs no graphics hardware.
/// throws  Error without series or items, with more than anybody can see, where counts differ, and
///         on a size out of range
Drawing draw_chart(const Chart& chart, const ChartOptions& options = {}, const Font& font = Font());

/// Ends of an axis that holds all finite values and 0, and the step of its lines: 1, 2 or 5 times a
/// power of ten.
struct ChartAxis {
  double low = 0, high = 1, step = 0.5;
};
ChartAxis chart_axis(const std::vector<double>& values);

}  // namespace clench
