// Axis of a plot: maps numbers to pixels, and chooses its lines and their labels.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace clench {

using Range = std::array<double, 2>;

struct PlotScale {
  Range range;
  double step = 1;
  bool logarithmic = false;  ///< are all numbers here exponents of ten?
  float from = 0, to = 0;    ///< pixels at the ends of the range

  float at(double value) const {
    const double part = (value - range[0]) / (range[1] - range[0]);
    return static_cast<float>(from + part * (to - from));
  }
  /// at multiples of the step, or of 1, 2 and 5 times powers of ten
  std::vector<double> lines() const;
  /// with as many digits as distinguish neighboring lines
  std::string text(double value) const;
};

/// room  minimum distance of two lines of the axis [pixels]
PlotScale make_scale(const Range& range, double pixels, double room, bool logarithmic);

}  // namespace clench
