#include "clench/render/mesh/refine.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "clench/base/watched.h"

namespace clench {
namespace {

Corner middle(const Corner& a, const Corner& b, bool on_image) {
  Corner out = a;
  if (on_image)
    out.paint = paint_of_place(0.5f * (place_of_paint(a.paint) + place_of_paint(b.paint)));
  out.p = 0.5f * (a.p + b.p);
  const Eigen::Vector3f n = a.n + b.n;
  const float length = n.norm();
  if (length > 1e-3f) out.n = n / length;
  return out;
}

// length of an edge relative to the allowed length at its position: equal from both sides
float excess(const Corner& a, const Corner& b, float limit) {
  const float away = std::max(1.0f, (0.5f * (a.p + b.p)).squaredNorm());
  return (a.p - b.p).squaredNorm() / (limit * limit * away);
}

void split(const Corner& a, const Corner& b, const Corner& c, float limit, bool on_image,
           std::vector<Corner>& out) {
  // rotate the triangle so that the edge that exceeds its limit most comes first
  const float ab = excess(a, b, limit), bc = excess(b, c, limit), ca = excess(c, a, limit);
  if (ab < bc || ab < ca)
    return bc >= ca ? split(b, c, a, limit, on_image, out) : split(c, a, b, limit, on_image, out);
  if (!(ab > 1)) {
    out.insert(out.end(), {a, b, c});
    return;
  }
  const Corner m = middle(a, b, on_image);
  split(a, m, c, limit, on_image, out);
  split(m, b, c, limit, on_image, out);
}

// estimated number of triangles for a limit
double count_after(const std::vector<Corner>& corners, double limit) {
  double count = 0;
  for (size_t i = 0; i < corners.size(); i += 3) {
    const Eigen::Vector3f ab = corners[i + 1].p - corners[i].p,
                          ac = corners[i + 2].p - corners[i].p;
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    // outside the scene's ball the allowed length grows, so the area counts by its logarithm
    const double area = std::min(0.5 * ab.cross(ac).norm(), 4 * (1 + std::log1p(longest)));
    count += 1 + 2 * longest / limit + 4 * area / (limit * limit);
  }
  return count;
}

}  // namespace

float affordable_length(const std::vector<Corner>& corners, float longest, size_t most) {
  while (longest < 4 && count_after(corners, longest) > static_cast<double>(most)) longest *= 1.5f;
  return longest;
}

std::vector<Corner> split_long_edges(const std::vector<Corner>& corners, float longest,
                                     bool on_image) {
  std::vector<Corner> out;
  out.reserve(corners.size());
  StopCheck check(1 << 12);
  for (size_t i = 0; i < corners.size(); i += 3) {
    check();
    split(corners[i], corners[i + 1], corners[i + 2], longest, on_image, out);
  }
  return out;
}

void append_shared(const std::vector<Corner>& corners, std::vector<Corner>& shared,
                   std::vector<uint32_t>& indices) {
  std::vector<uint32_t> order(corners.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<uint32_t>(i);
  const auto compare = [&](uint32_t a, uint32_t b) {
    return std::memcmp(&corners[a], &corners[b], sizeof(Corner));
  };
  StopCheck check(1 << 14);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    check();
    const int c = compare(a, b);
    return c != 0 ? c < 0 : a < b;
  });
  // each takes the position of the first of its kind, so that neighbors stay near
  std::vector<uint32_t> first(corners.size()), place(corners.size());
  for (size_t i = 0; i < order.size(); ++i)
    first[order[i]] =
        i > 0 && compare(order[i - 1], order[i]) == 0 ? first[order[i - 1]] : order[i];
  for (uint32_t i = 0; i < corners.size(); ++i) {
    if (first[i] == i) {
      place[i] = static_cast<uint32_t>(shared.size());
      shared.push_back(corners[i]);
    }
    indices.push_back(place[first[i]]);
  }
}

}  // namespace clench
