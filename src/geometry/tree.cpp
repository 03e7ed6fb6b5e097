#include "geometry/tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "geometry/shape.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Builds nodes in depth-first order over a permutation of the triangles.
class Builder {
 public:
  Builder(const Mesh& mesh, std::vector<Tree::Node>& nodes) : mesh_(mesh), nodes_(nodes) {
    const int count = static_cast<int>(mesh.triangles.size());
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0);
    for (int i = 0; i < count; ++i) {
      const auto c = mesh.corners(i);
      centres_.push_back((c[0] + c[1] + c[2]) / 3);
    }
    nodes_.reserve(2 * static_cast<size_t>(count));
    build(0, count);
  }

 private:
  int build(int begin, int end) {
    const int self = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    const OrientedBox box = fit(begin, end);
    nodes_[self].box = box;
    nodes_[self].size = box.half.norm();
    if (end - begin == 1) {
      nodes_[self].triangle = order_[begin];
      return self;
    }
    const int middle = split(begin, end, box);
    build(begin, middle);
    const int right = build(middle, end);
    nodes_[self].right = right;
    return self;
  }

  // the tighter of a box along the principal directions and one along the mesh's axes
  OrientedBox fit(int begin, int end) const {
    const OrientedBox plain = bound(begin, end, Matrix3d::Identity());
    const OrientedBox turned = bound(
        begin, end, end - begin == 1 ? triangle_axes(order_[begin]) : principal_axes(begin, end));
    return surface(turned.half) < surface(plain.half) ? turned : plain;
  }

  static double surface(const Vector3d& half) {
    return half.x() * half.y() + half.y() * half.z() + half.z() * half.x();
  }

  OrientedBox bound(int begin, int end, const Matrix3d& axes) const {
    const Vector3d origin = mesh_.corners(order_[begin])[0];
    Bounds bounds;
    for (int i = begin; i < end; ++i)
      for (const int v : mesh_.triangles[order_[i]])
        bounds.add(axes.transpose() * (mesh_.vertices[v] - origin));
    return {axes, origin + axes * bounds.centre(), 0.5 * bounds.size()};
  }

  // along the longest edge and the normal: the smallest box of a triangle
  Matrix3d triangle_axes(int triangle) const {
    const auto c = mesh_.corners(triangle);
    Vector3d longest = c[1] - c[0];
    for (const Vector3d& edge : {Vector3d(c[2] - c[1]), Vector3d(c[0] - c[2])})
      if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
    return frame(longest, (c[1] - c[0]).cross(c[2] - c[0]));
  }

  // first column along `along`, third as near to `normal` as may be; any frame where these do
  // not tell
  static Matrix3d frame(const Vector3d& along, const Vector3d& normal) {
    Matrix3d axes = Matrix3d::Identity();
    const Vector3d x = along.stableNormalized();
    if (!(x.norm() > 0.5)) return axes;
    Vector3d y = normal.stableNormalized().cross(x);
    if (!(y.norm() > 0.5)) y = x.unitOrthogonal();
    y = (y - x * x.dot(y)).normalized();
    axes << x, y, x.cross(y);
    return axes;
  }

  // eigenvectors of the area-weighted covariance of the surface
  Matrix3d principal_axes(int begin, int end) const {
    const Vector3d origin = mesh_.corners(order_[begin])[0];
    double area = 0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    for (int i = begin; i < end; ++i) {
      auto c = mesh_.corners(order_[i]);
      for (Vector3d& p : c) p -= origin;
      const double a = (c[1] - c[0]).cross(c[2] - c[0]).norm();
      const Vector3d sum = c[0] + c[1] + c[2];
      area += a;
      first += a / 3 * sum;
      second += a / 12 * (sum * sum.transpose());
      for (const Vector3d& p : c) second += a / 12 * (p * p.transpose());
    }
    if (!(area > 0)) return Matrix3d::Identity();
    first /= area;
    const Matrix3d spread = second / area - first * first.transpose();
    // scaled to one: the solver has an absolute threshold
    const double scale = spread.cwiseAbs().maxCoeff();
    if (!(scale > 0)) return Matrix3d::Identity();
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread / scale);
    return frame(solver.eigenvectors().col(2), solver.eigenvectors().col(0));
  }

  // Triangles to both sides of their mean along the longest axis; half and half where that is
  // lopsided, which also keeps the tree shallow.
  int split(int begin, int end, const OrientedBox& box) {
    int longest;
    box.half.maxCoeff(&longest);
    const Vector3d axis = box.axes.col(longest), origin = box.centre;
    const auto along = [&](int t) { return axis.dot(centres_[t] - origin); };
    double mean = 0;
    for (int i = begin; i < end; ++i) mean += along(order_[i]);
    mean /= end - begin;
    const auto first = order_.begin() + begin, last = order_.begin() + end;
    const int middle = static_cast<int>(
        std::partition(first, last, [&](int t) { return along(t) < mean; }) - order_.begin());
    const int smaller = std::min(middle - begin, end - middle);
    if (smaller > 0 && smaller >= (end - begin) / 8) return middle;
    const int half = begin + (end - begin) / 2;
    std::nth_element(first, order_.begin() + half, last, [&](int s, int t) {
      const double x = along(s), y = along(t);
      return x < y || (x == y && s < t);
    });
    return half;
  }

  const Mesh& mesh_;
  std::vector<Tree::Node>& nodes_;
  std::vector<int> order_;
  std::vector<Vector3d> centres_;
};

// How far the boxes stay apart along the cross products of their axes, at most 1 long: a lower
// bound.
double gap_across_edges(const Matrix3d& turn, const Matrix3d& shadow, const Vector3d& offset,
                        const Vector3d& half_a, const Vector3d& half_b) {
  double most = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      most = std::max(most, std::abs(offset[i2] * turn(i1, j) - offset[i1] * turn(i2, j)) -
                                half_a[i1] * shadow(i2, j) - half_a[i2] * shadow(i1, j) -
                                half_b[j1] * shadow(i, j2) - half_b[j2] * shadow(i, j1));
    }
  return most;
}

}  // namespace

double box_slack(const Bounds& bounds, const Vector3d& p) {
  const Vector3d reach =
      bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).cwiseMax(p.cwiseAbs());
  return 256 * epsilon * reach.maxCoeff();
}

double gap(const OrientedBox& a, const OrientedBox& b, const Reach& reach, double slack) {
  const Vector3d between = b.centre - a.centre;
  const double parted = reach.along.dot(between) -
                        (a.axes.transpose() * reach.along).cwiseAbs().dot(a.half) -
                        (b.axes.transpose() * reach.along).cwiseAbs().dot(b.half) - slack;
  if (parted > reach.distance) return parted;

  // from either box: how far the other one's shadow on its axes stays away
  const Matrix3d turn = a.axes.transpose() * b.axes, shadow = turn.cwiseAbs();
  const Vector3d offset = a.axes.transpose() * between;
  const Vector3d from_a = offset.cwiseAbs() - a.half - shadow * b.half;
  const Vector3d from_b =
      (turn.transpose() * offset).cwiseAbs() - b.half - shadow.transpose() * a.half;
  const double squared =
      std::max(from_a.cwiseMax(0).squaredNorm(), from_b.cwiseMax(0).squaredNorm());
  if (squared > 0) return std::max(parted, std::sqrt(squared) - slack);
  return std::max(parted, gap_across_edges(turn, shadow, offset, a.half, b.half) - slack);
}

Tree::Tree(const Mesh& mesh) { Builder(mesh, nodes_); }

Placement::Placement(const Shape& a, const Shape& b, const Pose& X_AB)
    : mesh_a_(a.mesh()),
      mesh_b_(b.mesh()),
      tree_a_(a.tree()),
      tree_b_(b.tree()),
      rotation_(X_AB.rotation.normalized().toRotationMatrix()),
      position_(X_AB.position),
      slack_(box_slack(a.bounds(), position_) + box_slack(b.bounds(), position_)) {
  const Eigen::Quaterniond& q = X_AB.rotation;
  if (!(std::abs(q.norm() - 1) < 0.1))
    fail("geometry query: pose wants a unit quaternion, got ({}, {}, {}, {})", q.w(), q.x(), q.y(),
         q.z());
  const Vector3d& p = position_;
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > largest_coordinate)
    fail("geometry query: position of the pose must be finite and within {} [m], got ({}, {}, {})",
         largest_coordinate, p.x(), p.y(), p.z());
}

Corners Placement::corners_a(int triangle) const { return mesh_a_.corners(triangle); }

Corners Placement::corners_b(int triangle) const {
  Corners c = mesh_b_.corners(triangle);
  for (Vector3d& p : c) p = to_a(p);
  return c;
}

}  // namespace clench
