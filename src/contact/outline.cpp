#include "clench/contact/outline.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "clench/base/watched.h"

namespace clench {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

static double cross(const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

// the complete convex hull, counter-clockwise from the leftmost point
static std::vector<int> hull(const Points& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return points[i].x() != points[j].x()   ? points[i].x() < points[j].x()
           : points[i].y() != points[j].y() ? points[i].y() < points[j].y()
                                            : i < j;
  });
  const auto same = [&](int i, int j) { return points[i] == points[j]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 3) return order;

  // the lower chain from left to right, then the upper one back
  std::vector<int> chain;
  const auto extend = [&](int next, size_t start) {
    while (chain.size() >= start + 2) {
      const Vector2d &o = points[chain[chain.size() - 2]], &a = points[chain.back()];
      if (cross(a - o, points[next] - o) > 0) break;
      chain.pop_back();
    }
    chain.push_back(next);
  };
  for (const int i : order) extend(i, 0);
  const size_t right = chain.size() - 1;
  for (size_t k = order.size() - 1; k-- > 0;) extend(order[k], right);
  chain.pop_back();
  return chain;
}

// index of the polygon's point farthest from p; the first of equals
static size_t farthest(const Points& points, const std::vector<int>& polygon, const Vector2d& p) {
  size_t best = 0;
  double far = -1;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const double d = (points[polygon[k]] - p).squaredNorm();
    if (d > far) far = d, best = k;
  }
  return best;
}

static double height(const Vector2d& p, const Vector2d& from, const Vector2d& to) {
  const double length = (to - from).norm();
  return length > 0 ? std::abs(cross(to - from, p - from)) / length : (p - from).norm();
}

// keeps those points of polygon[from..to] that are farther than `flat` from its chord; both ends
// stay
static void keep_corners(const Points& points, const std::vector<int>& polygon, size_t from,
                         size_t to, double flat, std::vector<char>& keep) {
  std::vector<std::pair<size_t, size_t>> open = {{from, to}};
  while (!open.empty()) {
    check_stop();
    const auto [low, high] = open.back();
    open.pop_back();
    size_t highest = low;
    double most = flat;
    for (size_t k = low + 1; k < high; ++k) {
      const double h = height(points[polygon[k]], points[polygon[low]], points[polygon[high]]);
      if (h > most) most = h, highest = k;
    }
    if (highest == low) continue;
    keep[highest] = 1;
    open.emplace_back(low, highest);
    open.emplace_back(highest, high);
  }
}

std::vector<int> outline(const Points& points, double flat) {
  std::vector<int> polygon = hull(points);
  if (polygon.size() < 2) return polygon;

  // begin at a true corner, go to the one farthest from it, and back
  Vector2d middle = Vector2d::Zero();
  for (const int i : polygon) middle += points[i] / static_cast<double>(polygon.size());
  std::rotate(polygon.begin(), polygon.begin() + farthest(points, polygon, middle), polygon.end());
  const size_t opposite = farthest(points, polygon, points[polygon[0]]);
  if (height(points[polygon[opposite]], points[polygon[0]], points[polygon[0]]) <= flat)
    return {polygon[0]};
  polygon.push_back(polygon[0]);

  std::vector<char> keep(polygon.size(), 0);
  keep[0] = keep[opposite] = 1;
  keep_corners(points, polygon, 0, opposite, flat, keep);
  keep_corners(points, polygon, opposite, polygon.size() - 1, flat, keep);
  std::vector<int> corners;
  for (size_t k = 0; k + 1 < polygon.size(); ++k)
    if (keep[k]) corners.push_back(polygon[k]);
  return corners;
}

std::vector<int> spread(const Points& points, int first, const std::vector<int>& others,
                        double radius, int most) {
  // smaller differences are ties that rounding must not decide
  constexpr double tie = 1 + 1e-9;
  std::vector<int> chosen = {first};
  std::vector<double> nearest(others.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(chosen.size()) < most) {
    check_stop();
    int best = -1;
    double far = radius;
    for (size_t k = 0; k < others.size(); ++k) {
      nearest[k] = std::min(nearest[k], (points[others[k]] - points[chosen.back()]).norm());
      const bool farther = nearest[k] > far * tie;
      const bool lower = best >= 0 && nearest[k] * tie > far && others[k] < others[best];
      if (farther || lower) far = nearest[k], best = static_cast<int>(k);
    }
    if (best < 0) break;
    chosen.push_back(others[best]);
  }
  return chosen;
}

}  // namespace clench
