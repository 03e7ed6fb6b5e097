// Labels under an axis: level if they fit, possibly shortened; otherwise upright.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "clench/render/figure/pen.h"

namespace clench {

class AxisLabels {
 public:
  /// pitch    from one label to the next [pixels]
  /// longest  maximum length of an upright label [pixels]
  /// height   of capital letters [pixels]
  AxisLabels(std::vector<std::string> texts, float pitch, float longest, float height,
             const Font& font);

  /// height that the labels take below their upper edge [pixels]
  float room() const { return room_; }
  /// Draws the labels around center(i); some are left out if even upright ones would overlap.
  /// top  upper edge of the labels
  void draw(Pen& pen, float top, const std::function<float(size_t)>& center,
            const Drawing::Color& color) const;

 private:
  std::vector<std::string> texts_;
  float pitch_, height_, room_;
  bool upright_;
};

}  // namespace clench
