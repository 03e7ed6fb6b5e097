#include "clench/render/view/pixel_rect.h"

#include <algorithm>

namespace clench {

std::vector<PixelRect> uncovered(const PixelRect& whole, std::span<const PixelRect> covered) {
  const int top = whole.y + whole.height, right = whole.x + whole.width;
  std::vector<int> edges = {whole.y, top};
  for (const PixelRect& rect : covered)
    for (const int y : {rect.y, rect.y + rect.height})
      if (!rect.empty()) edges.push_back(std::clamp(y, whole.y, top));
  std::ranges::sort(edges);
  std::vector<PixelRect> rest;
  // between successive edges, the covered ones are intervals of x
  for (size_t i = 0; i + 1 < edges.size(); ++i) {
    const int low = edges[i], high = edges[i + 1];
    if (low == high) continue;
    std::vector<PixelRect> across;
    for (const PixelRect& rect : covered)
      if (!rect.empty() && rect.y <= low && rect.y + rect.height >= high) across.push_back(rect);
    std::ranges::sort(across, {}, &PixelRect::x);
    int x = whole.x;
    const auto add = [&](int until) {
      const int end = std::min(until, right);
      if (end > x) rest.push_back({x, low, end - x, high - low});
    };
    for (const PixelRect& rect : across) {
      add(rect.x);
      x = std::max(x, rect.x + rect.width);
    }
    add(right);
  }
  return rest;
}

}  // namespace clench
