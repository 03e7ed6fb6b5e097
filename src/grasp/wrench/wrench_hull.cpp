#include "clench/grasp/wrench/wrench_hull.h"

#include <algorithm>
#include <numeric>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/base/watched.h"

namespace clench {

static constexpr double same_point = 1e-12;
static constexpr double hull_shifts[] = {0, 1e-11, 1e-9, 1e-7, 1e-5};

// indices of points that are not near an earlier one, ascending
static std::vector<int> distinct(const Eigen::MatrixXd& points) {
  std::vector<int> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::pair(points(0, i), i) < std::pair(points(0, j), j); });
  std::vector<char> repeats(points.cols(), 0);
  StopCheck check(1 << 12);
  for (size_t k = 0; k < order.size(); ++k) {
    if (repeats[order[k]]) continue;
    for (size_t l = k + 1; l < order.size(); ++l) {
      check();
      if (points(0, order[l]) - points(0, order[k]) > same_point) break;
      if ((points.col(order[l]) - points.col(order[k])).cwiseAbs().maxCoeff() <= same_point)
        repeats[order[l]] = 1;
    }
  }
  std::vector<int> out;
  for (int i = 0; i < points.cols(); ++i)
    if (!repeats[i]) out.push_back(i);
  return out;
}

Hull wrench_hull(const Eigen::MatrixXd& points) {
  const std::vector<int> kept = distinct(points);
  const Eigen::MatrixXd exact = points(Eigen::all, kept);
  for (const double shift : hull_shifts) {
    Eigen::MatrixXd shifted = exact;
    Random random(1);
    if (shift > 0)
      for (double& x : shifted.reshaped()) x += shift * random.uniform(-1, 1);
    try {
      Hull hull = convex_hull(shifted);
      for (auto& facet : hull.facets)
        for (int& corner : facet) corner = kept[corner];
      return hull;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::internal || shift == *std::rbegin(hull_shifts)) throw;
    }
  }
  return {};
}

}  // namespace clench
