#include "clench/render/figure/plot_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/math/round_step.h"

namespace clench {

static constexpr int max_lines = 8192;  // one per pixel of the largest figure

// products of digits and powers of ten that lie in the range
static std::vector<double> decades(const Range& range, const std::vector<double>& digits) {
  std::vector<double> out;
  const double first = std::floor(range[0]);
  const int count = floor_between(range[1] - first, 0, 700);
  for (int i = 0; i <= count; ++i)
    for (const double digit : digits) {
      const double value = first + i + std::log10(digit);
      if (value >= range[0] - 1e-9 && value <= range[1] + 1e-9) out.push_back(value);
    }
  return out;
}

std::vector<double> PlotScale::lines() const {
  if (logarithmic && step <= 1) {
    // with less than a decade, all digits are used
    if (const auto all = decades(range, {1, 2, 3, 4, 5, 6, 7, 8, 9});
        all.size() >= 4 && all.size() <= 8)
      return all;
    if (const auto some = decades(range, {1, 2, 5}); some.size() >= 2 && some.size() <= 8)
      return some;
    if (const auto some = decades(range, {1}); some.size() >= 2) return some;
  }
  std::vector<double> out;
  const double slack = 1e-9 * step, first = std::ceil((range[0] - slack) / step);
  // by index, since adding 1 to a large number does not change it
  const int count = floor_between((range[1] - range[0]) / step, 0, max_lines) + 1;
  for (int i = 0; i <= count; ++i) {
    const double value = (first + i) * step;
    if (value <= range[1] + slack) out.push_back(value == 0 ? 0.0 : value);
  }
  return out;
}

std::string PlotScale::text(double value) const {
  if (logarithmic) {
    const std::string plain = fmt::format("{:.4g}", std::pow(10.0, value)),
                      exact = fmt::format("{:.3e}", std::pow(10.0, value));
    const size_t e = exact.find('e');
    const int power = std::atoi(exact.c_str() + e + 1);
    if (std::abs(power) < 4) return plain;
    return fmt::format("{:.4g}e{}", std::atof(exact.substr(0, e).c_str()), power);
  }
  const double largest = std::max(std::abs(range[0]), std::abs(range[1]));
  const double digits = std::ceil(std::log10(largest / step)) + 1;
  return fmt::format("{:.{}g}", value, floor_between(digits, 3, 15));
}

PlotScale make_scale(const Range& range, double pixels, double room, bool logarithmic) {
  const double count = std::max(1.0, pixels / room),
               step = round_step((range[1] - range[0]) / count);
  // powers of ten have integer steps
  return {range, logarithmic && range[1] - range[0] > 2 ? std::max(1.0, std::ceil(step)) : step,
          logarithmic};
}

}  // namespace clench
