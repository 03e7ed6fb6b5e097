// Bar chart: one panel per series, one column per item, all panels over a common axis.
#pragma once
#include <string>
#include <vector>

#include "clench/render/figure/drawing.h"

namespace clench {

struct ChartSeries {
  std::string name;            ///< including its unit
  std::vector<double> values;  ///< one per item; values that are not finite are marked by a cross
  bool higher_is_better = true;
};

struct Chart {
  std::string title = {};
  std::vector<std::string> labels = {};  ///< one per item; empty: the items are numbered from 1
  std::vector<ChartSeries> series = {};
};

struct ChartOptions {
  int width = 960, height = 0;  ///< pixels, 64..8192; a height of 0 is computed from the panels
};

/// Each panel has its own scale, which begins at 0, or below 0 if values are negative. The column
/// of its best value is the darkest, and values are written at the columns if they fit. Texts are
/// UTF-8; long ones are shortened in the middle. It needs no graphics hardware.
/// throws  Error if there are no series or items, or too many to be legible, if counts differ, or
///         if the size is out of range
Drawing draw_chart(const Chart& chart, const ChartOptions& options = {}, const Font& font = Font());

/// Ends of an axis that covers 0 and all finite values, and the step of its lines: 1, 2 or 5 times
/// a power of ten.
struct ChartAxis {
  double low = 0, high = 1, step = 0.5;
};
ChartAxis chart_axis(const std::vector<double>& values);

}  // namespace clench
