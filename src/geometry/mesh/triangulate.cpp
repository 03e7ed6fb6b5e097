#include "clench/geometry/mesh/triangulate.h"

#include <Eigen/Geometry>
#include <numeric>

#include "clench/base/error.h"

namespace clench {

namespace {

using FlatCorners = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The polygon projected along its normal, counter-clockwise.
/// source  Newell (1974), normal of a polygon
FlatCorners flatten(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = corners.front();
  for (size_t i = 0; i < corners.size(); ++i)
    normal += (corners[i] - origin).cross(corners[(i + 1) % corners.size()] - origin);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  FlatCorners flat;
  for (const auto& p : corners) flat.emplace_back(p[u], normal[axis] < 0 ? -p[v] : p[v]);
  return flat;
}

/// No corner is reflex, and the outline winds once.
bool is_convex(const FlatCorners& p) {
  const size_t n = p.size();
  int turns_back = 0;
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d a = p[(i + 1) % n] - p[i], b = p[(i + 2) % n] - p[(i + 1) % n];
    if (cross(a, b) < 0) return false;
    if ((a.x() < 0) != (b.x() < 0)) ++turns_back;
  }
  return turns_back <= 2;
}

bool inside(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
            const Eigen::Vector2d& c) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// Is the corner convex, with no other corner in its triangle?
bool is_ear(const FlatCorners& p, const std::vector<int>& rest, size_t i) {
  const size_t n = rest.size();
  const auto &a = p[rest[(i + n - 1) % n]], &b = p[rest[i]], &c = p[rest[(i + 1) % n]];
  if (!(cross(b - a, c - b) > 0)) return false;
  for (size_t k = 0; k < n; ++k) {
    const auto& q = p[rest[k]];
    if (q != a && q != b && q != c && inside(q, a, b, c)) return false;
  }
  return true;
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Eigen::Vector3d>& corners, bool convex,
                                  size_t* work) {
  std::vector<Triangle> out;
  const int n = static_cast<int>(corners.size());
  if (n < 3) return out;
  if (n == 3) return {{0, 1, 2}};
  const FlatCorners flat = convex ? FlatCorners() : flatten(corners);
  if (convex || is_convex(flat)) {
    for (int i = 1; i + 1 < n; ++i) out.push_back({0, i, i + 1});
    return out;
  }
  if (n > max_concave_corners)
    fail(ErrorKind::limit, "expected at most {} corners of a face that is not convex, got {}",
         max_concave_corners, n);

  // ear clipping; if a self-intersecting outline has no ear, any corner is cut
  constexpr int max_failures = 8;
  std::vector<int> rest(n);
  std::iota(rest.begin(), rest.end(), 0);
  size_t start = 0;
  int failures = 0;
  while (rest.size() > 3) {
    const size_t left = rest.size();
    size_t ear = start % left, looked = 0;
    while (failures < max_failures && looked < left && !is_ear(flat, rest, (start + looked) % left))
      ++looked;
    if (work) *work += (looked + 1) * left;
    if (looked < left)
      ear = (start + looked) % left;
    else
      ++failures;
    out.push_back({rest[(ear + left - 1) % left], rest[ear], rest[(ear + 1) % left]});
    rest.erase(rest.begin() + static_cast<long>(ear));
    start = ear;
  }
  out.push_back({rest[0], rest[1], rest[2]});
  return out;
}

}  // namespace clench
