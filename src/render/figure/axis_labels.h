// Names under an axis: level where they fit, perhaps shortened, upright where not.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "clench/render/figure/pen.h"

namespace clench {

class AxisLabels {
 public:
  /// pitch    from one to the next [pixels]
  /// longest  that an upright one may be [pixels]
  /// height   of capital letters [pixels]
  AxisLabels(std::vector<std::string> texts, float pitch, float longest, float height,
             const Font& font);

  /// that they take below their upper edge [pixels]
  float room() const { return room_; }
  /// Draws them around center(i); some are left out where even upright ones would overlap.
  /// top  their upper edge
  void draw(Pen& pen, float top, const std::function<float(size_t)>& center,
            const Drawing::Color& color) const;

 private:
  std::vector<std::string> texts_;
  float pitch_, height_, room_;
  bool upright_;
};

}  // namespace clench
