#include "clench/geometry/tree/tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "clench/base/convert.h"
#include "clench/base/progress.h"
#include "clench/base/watched.h"
#include "clench/geometry/mesh/mesh.h"
#include "clench/geometry/mesh/principal_axes.h"
#include "clench/geometry/tree/lanes.h"
#include "clench/geometry/tree/make_bounding_polytope.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector3d;

static constexpr int bin_count = 16;
// after this many splits by area groups are split in the middle, which bounds the depth
static constexpr int deep = 38;

static float rounded_up(double x) {
  const float f = static_cast<float>(x);
  return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

static double to_single(double x) { return static_cast<float>(x); }

static double surface(const Vector3d& size) {
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

// Groups of triangles, split by binned surface area (source  Wald (2007)) until eight are found;
// then each of them likewise, down to eight triangles.
class TreeBuilder {
 public:
  TreeBuilder(const Mesh& mesh, Tree& tree, const Progress& progress)
      : mesh_(mesh), tree_(tree), progress_(progress) {
    const int count = static_cast<int>(mesh.triangles.size());
    // unused vertices are ignored
    Bounds bounds;
    for (const Triangle& t : mesh.triangles)
      for (const int v : t) bounds.add(mesh.vertices[v]);
    const Vector3d center = bounds.center();
    Vector3d::Map(tree.center_) = center;
    points_.reserve(mesh.vertices.size());
    gathered_.assign(mesh.vertices.size(), 0);
    for (const Vector3d& p : mesh.vertices) points_.push_back(p - center);
    items_.reserve(count);
    for (int i = 0; i < count; ++i) {
      Item item{{}, i};
      for (const int v : mesh.triangles[i]) {
        item.bounds.add(points_[v]);
        tree.radius_ = std::max(tree.radius_, points_[v].stableNorm());
      }
      items_.push_back(item);
    }
    tree.boxes_.reserve(static_cast<size_t>(count) / 16 + 2);
    tree.leaves_.reserve(static_cast<size_t>(count) / 5 + 1);
    tree.boxes_.emplace_back();
    fill(0, {{0, count, 0}});
    encase();
  }

 private:
  struct Item {
    Bounds bounds;
    int triangle;
    Vector3d center() const { return bounds.center(); }
  };
  struct Group {
    int begin, end, depth;
    int count() const { return end - begin; }
  };

  using Four = Lanes<double, 2, 4>;

  void encase() {
    std::vector<char> used(points_.size(), 0);
    for (const Triangle& t : mesh_.triangles)
      for (const int v : t) used[v] = 1;
    std::vector<Vector3d> points;
    for (size_t v = 0; v < points_.size(); ++v)
      if (used[v]) points.push_back(points_[v]);
    Matrix3d axes;
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 3; ++m) axes(m, k) = tree_.boxes_[0].axes[3 * k + m][0];
    tree_.bounding_polytope_ = make_bounding_polytope(points, axes);
  }

  // a bundle of the groups' boxes, followed by what is below
  void fill(int bundle, const std::vector<Group>& groups) {
    progress_.check();
    BoxBundle out;
    for (int lane = 0; lane < 8; ++lane) {
      out.child[lane] = -1;
      // unused lanes repeat the first
      if (lane < static_cast<int>(groups.size()))
        fit(groups[lane], out, lane);
      else
        copy_lane(out, 0, lane);
    }
    for (size_t lane = 0; lane < groups.size(); ++lane) {
      if (groups[lane].count() <= 8) {
        out.child[lane] = 2 * add_leaf(groups[lane]) + 1;
      } else {
        const int below = static_cast<int>(tree_.boxes_.size());
        tree_.boxes_.emplace_back();
        out.child[lane] = 2 * below;
        fill(below, split_up(groups[lane]));
      }
    }
    tree_.boxes_[bundle] = out;
  }

  static void copy_lane(BoxBundle& bundle, int from, int to) {
    for (auto& row : bundle.axes) row[to] = row[from];
    for (auto& row : bundle.center) row[to] = row[from];
    for (auto& row : bundle.half) row[to] = row[from];
    bundle.size[to] = bundle.size[from];
  }

  int add_leaf(const Group& group) {
    TriangleBundle leaf;
    for (int lane = 0; lane < 8; ++lane) {
      const bool used = lane < group.count();
      const int triangle = items_[group.begin + (used ? lane : 0)].triangle;
      leaf.triangle[lane] = used ? triangle : -1;
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m)
          leaf.corners[3 * k + m][lane] = static_cast<float>(point(triangle, k)[m]);
    }
    tree_.leaves_.push_back(leaf);
    return static_cast<int>(tree_.leaves_.size()) - 1;
  }

  const Vector3d& point(int triangle, int k) const { return points_[mesh_.triangles[triangle][k]]; }

  // up to eight groups: the one of largest surface is split next; those that fill one more bundle
  // of leaves stay complete as long as there are larger ones
  std::vector<Group> split_up(const Group& group) {
    const int whole = group.count() > 64 ? 64 : 8;
    std::vector<Group> groups = {group};
    std::vector<double> sizes = {std::numeric_limits<double>::infinity()};
    while (groups.size() < 8) {
      int largest = -1;
      for (int i = 0; i < static_cast<int>(groups.size()); ++i)
        if (groups[i].count() > whole && (largest < 0 || sizes[i] > sizes[largest])) largest = i;
      if (largest < 0) break;
      const Group old = groups[largest];
      const int middle = split(old);
      groups[largest] = {old.begin, middle, old.depth + 1};
      groups.insert(groups.begin() + largest + 1, {middle, old.end, old.depth + 1});
      sizes[largest] = size_of(groups[largest]);
      sizes.insert(sizes.begin() + largest + 1, size_of(groups[largest + 1]));
    }
    return groups;
  }

  double size_of(const Group& group) const {
    Bounds bounds;
    for (int i = group.begin; i < group.end; ++i) join(bounds, items_[i].bounds);
    return surface(bounds.size());
  }

  static void join(Bounds& bounds, const Bounds& other) {
    bounds.low = bounds.low.cwiseMin(other.low);
    bounds.high = bounds.high.cwiseMax(other.high);
  }

  // cost of visiting a group: its surface, for each leaf that it fills
  static double cost(const Bounds& bounds, int count) {
    return count == 0 ? 0 : surface(bounds.size()) * ((count + 7) / 8);
  }

  struct Cut {
    double cost = std::numeric_limits<double>::infinity();
    int axis = 0, bin = 0;
  };

  static int bin_of(double x, double low, double scale) {
    return floor_between((x - low) * scale, 0, bin_count - 1);
  }

  static void find_cut(const std::array<Bounds, bin_count>& bins,
                       const std::array<int, bin_count>& counts, int axis, Cut& best) {
    std::array<double, bin_count> right_costs;
    Bounds right, left;
    int right_count = 0, left_count = 0;
    for (int i = bin_count - 1; i > 0; --i) {
      join(right, bins[i]);
      right_count += counts[i];
      right_costs[i] =
          right_count == 0 ? std::numeric_limits<double>::infinity() : cost(right, right_count);
    }
    for (int i = 1; i < bin_count; ++i) {
      join(left, bins[i - 1]);
      left_count += counts[i - 1];
      if (left_count == 0) continue;
      const double sum = cost(left, left_count) + right_costs[i];
      if (sum < best.cost) best = {sum, axis, i};
    }
  }

  // partitions the items of a group.
  // returns  start of the second half
  int split(const Group& group) {
    check_stop();
    Bounds centers;
    for (int i = group.begin; i < group.end; ++i) centers.add(items_[i].center());
    const Vector3d scale = bin_count * centers.size().cwiseInverse();
    if (group.depth >= deep) return split_in_half(group, centers);
    std::array<std::array<Bounds, bin_count>, 3> bins;
    std::array<std::array<int, bin_count>, 3> counts{};
    for (int i = group.begin; i < group.end; ++i) {
      const Vector3d center = items_[i].center();
      for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(scale[axis])) continue;
        const int bin = bin_of(center[axis], centers.low[axis], scale[axis]);
        join(bins[axis][bin], items_[i].bounds);
        ++counts[axis][bin];
      }
    }
    Cut cut;
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(scale[axis])) find_cut(bins[axis], counts[axis], axis, cut);
    if (!(cut.cost < std::numeric_limits<double>::infinity())) return split_in_half(group, centers);
    const auto middle = std::partition(
        items_.begin() + group.begin, items_.begin() + group.end, [&](const Item& item) {
          return bin_of(item.center()[cut.axis], centers.low[cut.axis], scale[cut.axis]) < cut.bin;
        });
    return static_cast<int>(middle - items_.begin());
  }

  int split_in_half(const Group& group, const Bounds& centers) {
    int axis;
    centers.size().maxCoeff(&axis);
    const int middle = group.begin + group.count() / 2;
    std::nth_element(items_.begin() + group.begin, items_.begin() + middle,
                     items_.begin() + group.end, [&](const Item& s, const Item& t) {
                       const double x = s.center()[axis], y = t.center()[axis];
                       return x < y || (x == y && s.triangle < t.triangle);
                     });
    return middle;
  }

  // Stores the smallest of several boxes around a group in a lane: along the mesh's axes, along the
  // principal directions, for small groups along edges, and close to the best of these.
  void fit(const Group& group, BoxBundle& bundle, int lane) {
    gather(group);
    Matrix3d axes = Matrix3d::Identity();
    Bounds best = bounds_along(axes);
    const auto offer = [&](const Matrix3d& given) {
      check_stop();
      // as they will be stored
      const Matrix3d turned = given.unaryExpr(&to_single);
      const Bounds bounds = bounds_along(turned);
      const bool smaller = surface(bounds.size()) < surface(best.size());
      if (smaller) best = bounds, axes = turned;
      return smaller;
    };
    const Matrix3d principal = spread(group);
    offer(principal);
    if (group.count() <= 8)
      for (int i = group.begin; i < group.end; ++i) offer_sides(items_[i].triangle, offer);
    else if (group.count() <= 64)
      offer(axes_of(longest_edge(group), principal.col(0)));
    // then rotated slightly about each of its axes, in both directions
    for (const double angle : {0.4, 0.2, 0.1})
      for (int k = 0; k < 3; ++k)
        for (const double turn : {angle, -angle})
          if (offer(axes * Eigen::AngleAxisd(turn, Vector3d::Unit(k)).toRotationMatrix())) break;
    store(axes, best, bundle, lane);
  }

  // the vertices of a group, coordinate by coordinate, the last one repeated to fill the lanes
  void gather(const Group& group) {
    for (auto& list : corners_) list.clear();
    const auto add = [&](const Vector3d& p) {
      for (int m = 0; m < 3; ++m) corners_[m].push_back(p[m]);
    };
    ++fitted_;
    for (int i = group.begin; i < group.end; ++i)
      for (const int v : mesh_.triangles[items_[i].triangle])
        if (gathered_[v] != fitted_) gathered_[v] = fitted_, add(points_[v]);
    while (corners_[0].size() % Four::count != 0) add(point(items_[group.end - 1].triangle, 2));
  }

  // least and greatest coordinates of the gathered corners along the columns of axes
  Bounds bounds_along(const Matrix3d& axes) const {
    const double* const xs = corners_[0].data();
    const double* const ys = corners_[1].data();
    const double* const zs = corners_[2].data();
    const size_t count = corners_[0].size();
    Four low[3], high[3];
    for (int k = 0; k < 3; ++k) {
      low[k] = Four::all(std::numeric_limits<double>::infinity());
      high[k] = Four::all(-std::numeric_limits<double>::infinity());
    }
    for (size_t i = 0; i < count; i += Four::count) {
      const Four x = Four::stored(xs + i), y = Four::stored(ys + i), z = Four::stored(zs + i);
      for (int k = 0; k < 3; ++k) {
        const Four along = x * axes(0, k) + y * axes(1, k) + z * axes(2, k);
        low[k] = min(along, low[k]);
        high[k] = max(along, high[k]);
      }
    }
    Bounds out;
    for (int k = 0; k < 3; ++k) {
      double lows[Four::count], highs[Four::count];
      low[k].store(lows), high[k].store(highs);
      out.low[k] = *std::min_element(lows, lows + Four::count);
      out.high[k] = *std::max_element(highs, highs + Four::count);
    }
    return out;
  }

  // along each edge of a triangle, and flat on it
  template <class Offer>
  void offer_sides(int triangle, const Offer& offer) const {
    Vector3d edges[3];
    for (int k = 0; k < 3; ++k) edges[k] = point(triangle, (k + 1) % 3) - point(triangle, k);
    const Vector3d normal = edges[0].cross(edges[1]).stableNormalized();
    for (const Vector3d& edge : edges) offer(axes_of(edge, normal));
  }

  static void store(const Matrix3d& axes, const Bounds& along, BoxBundle& bundle, int lane) {
    const Vector3d center = (axes * along.center()).unaryExpr(&to_single);
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
      // what is stored holds the points, to the rounding of double
      const double middle = axes.col(k).dot(center);
      const double half = std::max(along.high[k] - middle, middle - along.low[k]);
      bundle.half[k][lane] = rounded_up(half);
      squared += half * half;
      bundle.center[k][lane] = static_cast<float>(center[k]);
      for (int m = 0; m < 3; ++m) bundle.axes[3 * k + m][lane] = static_cast<float>(axes(m, k));
    }
    bundle.size[lane] = rounded_up(std::sqrt(squared));
  }

  // axes of the area-weighted covariance of the surface, shortest first
  Matrix3d spread(const Group& group) const {
    const Vector3d origin = point(items_[group.begin].triangle, 0);
    double area = 0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    for (int i = group.begin; i < group.end; ++i) {
      const int t = items_[i].triangle;
      const Vector3d a = point(t, 0) - origin, b = point(t, 1) - origin, c = point(t, 2) - origin;
      const double weight = (b - a).cross(c - a).norm();
      const Vector3d sum = a + b + c;
      area += weight;
      first += weight / 3 * sum;
      second += weight / 12 *
                (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    if (!(area > 0) || !std::isfinite(area)) return Matrix3d::Identity();
    first /= area;
    return principal_axes(second / area - first * first.transpose());
  }

  Vector3d longest_edge(const Group& group) const {
    Vector3d longest = Vector3d::Zero();
    for (int i = group.begin; i < group.end; ++i)
      for (int k = 0; k < 3; ++k) {
        const Vector3d edge = point(items_[i].triangle, (k + 1) % 3) - point(items_[i].triangle, k);
        if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
      }
    return longest;
  }

  // along the edge, and as close to the normal as possible
  static Matrix3d axes_of(const Vector3d& edge, const Vector3d& normal) {
    Matrix3d axes = Matrix3d::Identity();
    const Vector3d x = edge.stableNormalized();
    if (!(x.norm() > 0.5)) return axes;
    Vector3d y = normal.cross(x);
    if (!(y.norm() > 1e-3)) y = x.unitOrthogonal();
    y.normalize();
    axes << x, y, x.cross(y);
    return axes;
  }

  const Mesh& mesh_;
  Tree& tree_;
  const Progress& progress_;
  std::vector<Vector3d> points_;  // vertices about the center
  std::vector<Item> items_;
  std::array<std::vector<double>, 3> corners_;  // of the group being fitted
  std::vector<int> gathered_;                   // by vertex: the last group that used it
  int fitted_ = 0;                              // groups so far
};

Tree::Tree(const Mesh& mesh, const Progress& progress) {
  TreeBuilder(mesh, *this, progress);
  boxes_.shrink_to_fit();
  leaves_.shrink_to_fit();
}

size_t Tree::bytes() const {
  return sizeof *this + boxes_.size() * sizeof(BoxBundle) + leaves_.size() * sizeof(TriangleBundle);
}

}  // namespace clench
