#include "clench/geometry/query/penetration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <queue>

#include "clench/base/error.h"
#include "clench/geometry/query/depth_field.h"
#include "clench/geometry/query/placement.h"

namespace clench {

using Eigen::Vector3d;

namespace {

// A region that may contain the deepest point. Triangles of a group are indices into the search's
// list.
struct Region {
  enum class Kind { group, surface, solid };
  Kind kind = Kind::group;
  double bound = 0;  // upper bound on the depth in it [m]
  int order = 0;     // of creation; breaks ties between equal bounds
  int begin = 0, end = 0;
  std::array<Vector3d, 4> points{};
  // triangles of a that determine the bound; likely to determine those of the halves
  std::array<int, 4> triangles = {-1, -1, -1, -1};
  int nearest = -1;
  bool held = false;  // is this simplex of the solid certainly inside b?

  std::span<Vector3d> corners() {
    return {points.data(), kind == Kind::solid ? size_t{4} : size_t{3}};
  }
};

struct Deeper {
  bool operator()(const Region& x, const Region& y) const {
    return x.bound < y.bound || (x.bound == y.bound && x.order > y.order);
  }
};

// Best-first search over regions; all points are in the frame of a.
class DeepestPoint {
 public:
  DeepestPoint(const Shape& a, const Shape& b, const Pose& X_AB, const PenetrationOptions& options)
      : b_(b), field_(a, options.progress), placement_(a, b, X_AB), options_(options) {
    smallest_ = std::min(a.radius(), b.radius());
    for (const Vector3d& p : b.mesh().vertices) vertices_.push_back(placement_.to_a(p));
  }

  Penetration find() {
    add_crossings();
    add_surface();
    if (b_.closed()) add_solid();
    for (int step = 1; !queue_.empty(); ++step) {
      if (step % 64 == 0) options_.progress.check();
      Region region = queue_.top();
      if (!matters(region.bound)) break;
      queue_.pop();
      queue_.size() < options_.max_regions ? split(region) : search_depth_first(region);
    }
    if (!queue_.empty()) left_out_ = std::max(left_out_, queue_.top().bound);
    best_.bound = best_.depth > 0 ? std::max(best_.depth, left_out_) : left_out_;
    return best_;
  }

 private:
  double tolerance() const {
    if (best_.depth > 0) return options_.absolute + options_.relative * best_.depth;
    return std::min(options_.absolute, 1e-5 * smallest_);
  }

  bool matters(double bound) const { return bound > best_.depth + tolerance(); }

  void push(Region region) {
    if (!matters(region.bound)) {
      left_out_ = std::max(left_out_, region.bound);
      return;
    }
    region.order = ++count_;
    branch_ ? branch_->push_back(std::move(region)) : queue_.push(std::move(region));
  }

  void split(Region& region) {
    region.kind == Region::Kind::group ? open_group(region) : halve(region);
  }

  // Searches a region completely. The length of the stack is bounded by the depth of the nesting.
  void search_depth_first(const Region& first) {
    std::vector<Region> branch = {first};
    branch_ = &branch;
    for (int step = 1; !branch.empty(); ++step) {
      if (step % 64 == 0) options_.progress.check();
      Region region = std::move(branch.back());
      branch.pop_back();
      if (matters(region.bound))
        split(region);
      else
        left_out_ = std::max(left_out_, region.bound);
    }
    branch_ = nullptr;
  }

  bool improves(double distance) const {
    return distance > std::max(best_.depth, placement_.rounding());
  }
  // A point inside both, with the surface point of a nearest to it.
  void take(const Vector3d& p, double distance, int triangle) {
    if (!improves(distance)) return;
    best_.depth = distance;
    best_.point = p;
    best_.triangle = field_.triangle_of_solid(triangle);
  }

  // --- crossings ---

  // Tries the corners of triangles of b that cross the surface of a, and the mean of the points where
  // edges pass through. Some of them are inside, however small the overlap is.
  void add_crossings() {
    constexpr int max_pairs = 4096;
    std::map<int, std::pair<Vector3d, int>> sums;  // by triangle of b
    int pairs = 0;
    for_meeting_pairs(placement_.trees(), [&](int in_a, int in_b) {
      auto& [sum, count] = sums.try_emplace(in_b, Vector3d::Zero(), 0).first->second;
      const Corners a = placement_.corners_a(in_a), b = placement_.corners_b(in_b);
      for (int k = 0; k < 3; ++k) {
        if (const auto p = crossing(a[k], a[(k + 1) % 3], b)) sum += *p, ++count;
        if (const auto p = crossing(b[k], b[(k + 1) % 3], a)) sum += *p, ++count;
      }
      return ++pairs == max_pairs;
    });
    const auto try_point = [&](const Vector3d& p) {
      const ClosestPoint near = field_.nearest(p);
      if (improves(near.distance) && field_.holds(p)) take(p, near.distance, near.triangle);
    };
    for (const auto& [triangle, points] : sums) {
      for (const int v : b_.mesh().triangles[triangle]) try_point(vertices_[v]);
      if (points.second > 0) try_point(points.first / points.second);
    }
  }

  // Intersection of a segment and a triangle.
  static std::optional<Vector3d> crossing(const Vector3d& p, const Vector3d& q, const Corners& c) {
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
    const double from = normal.dot(p - c[0]), to = normal.dot(q - c[0]);
    if (from * to > 0 || from == to) return {};
    const Vector3d x = p + from / (from - to) * (q - p);
    for (int k = 0; k < 3; ++k)
      if (normal.dot((c[(k + 1) % 3] - c[k]).cross(x - c[k])) < 0) return {};
    return x;
  }

  // --- surface ---

  void add_surface() {
    Bounds box = field_.solid().bounds();
    box.low.array() -= placement_.rounding();
    box.high.array() += placement_.rounding();
    for (size_t i = 0; i < b_.mesh().triangles.size(); ++i) {
      Bounds own;
      for (const int v : b_.mesh().triangles[i]) own.add(vertices_[v]);
      if ((own.low.array() <= box.high.array()).all() &&
          (own.high.array() >= box.low.array()).all())
        triangles_.push_back(static_cast<int>(i));
    }
    if (!triangles_.empty()) add_group(0, static_cast<int>(triangles_.size()), bound_of_all(), -1);
  }

  double bound_of_all() const { return field_.solid().bounds().size().minCoeff() / 2; }

  Vector3d middle(int triangle) const {
    const auto& t = b_.mesh().triangles[triangle];
    return (vertices_[t[0]] + vertices_[t[1]] + vertices_[t[2]]) / 3;
  }

  void add_group(int begin, int end, double bound, int seed) {
    if (end - begin == 1) return add_triangle(triangles_[begin], bound, seed);
    Bounds box;
    for (int i = begin; i < end; ++i)
      for (const int v : b_.mesh().triangles[triangles_[i]]) box.add(vertices_[v]);
    const Vector3d center = box.center();
    const double radius = box.size().norm() / 2;
    const Probe probe = field_.probe(center, seed);
    push({.kind = Region::Kind::group,
          .bound = std::min(bound, probe.deepest(radius)),
          .begin = begin,
          .end = end,
          .nearest = probe.triangle});
  }

  void open_group(const Region& group) {
    Bounds box;
    for (int i = group.begin; i < group.end; ++i) box.add(middle(triangles_[i]));
    int axis;
    box.size().maxCoeff(&axis);
    const auto first = triangles_.begin() + group.begin, last = triangles_.begin() + group.end;
    const int half = (group.begin + group.end) / 2;
    std::nth_element(first, triangles_.begin() + half, last, [&](int i, int j) {
      const double x = middle(i)[axis], y = middle(j)[axis];
      return x < y || (x == y && i < j);
    });
    add_group(group.begin, half, group.bound, group.nearest);
    add_group(half, group.end, group.bound, group.nearest);
  }

  void add_triangle(int triangle, double bound, int seed) {
    Region piece{.kind = Region::Kind::surface, .bound = bound, .nearest = seed};
    for (int k = 0; k < 3; ++k) piece.points[k] = vertices_[b_.mesh().triangles[triangle][k]];
    add_simplex(std::move(piece));
  }

  // --- solid ---

  // the intersection of the bounding boxes, divided into six tetrahedra about a diagonal
  void add_solid() {
    Bounds own;
    for (const Vector3d& p : vertices_) own.add(p);
    const Vector3d low = own.low.cwiseMax(field_.solid().bounds().low),
                   high = own.high.cwiseMin(field_.solid().bounds().high);
    if ((low.array() >= high.array()).any()) return;
    std::array<int, 3> axes = {0, 1, 2};
    do {
      Region cell{.kind = Region::Kind::solid, .bound = bound_of_all()};
      cell.points[0] = low;
      for (int k = 0; k < 3; ++k) {
        cell.points[k + 1] = cell.points[k];
        cell.points[k + 1][axes[k]] = high[axes[k]];
      }
      add_simplex(std::move(cell));
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  bool holds(const Vector3d& p) const { return contains(b_, placement_.to_b(p)); }

  // Is the ball outside b? `held` returns: is it inside b?
  bool is_beside(const Sphere& ball, bool& held) const {
    const Vector3d p_B = placement_.to_b(ball.center);
    const Vector3d from = p_B - Vector3d::Map(b_.tree().center());
    bool crossed = false;
    for_near_triangles(b_.tree(), from.data(), placement_.rounding(), ball.radius, false,
                       [&](int) { return crossed = true; });
    if (crossed) return false;
    held = contains(b_, p_B);
    return !held;
  }

  // --- simplices ---

  void halve(Region& region) {
    const std::span<Vector3d> p = region.corners();
    size_t from = 0, to = 1;
    double longest = -1;
    for (size_t i = 0; i < p.size(); ++i)
      for (size_t j = i + 1; j < p.size(); ++j)
        if (const double length = (p[i] - p[j]).squaredNorm(); length > longest)
          longest = length, from = i, to = j;
    if (std::sqrt(longest) <= placement_.rounding()) {
      left_out_ = std::max(left_out_, region.bound);
      return;
    }
    const Vector3d middle = (p[from] + p[to]) / 2;
    Region other = region;
    region.points[from] = middle;
    other.points[to] = middle;
    add_simplex(std::move(region));
    add_simplex(std::move(other));
  }

  void add_simplex(Region region) {
    const bool solid = region.kind == Region::Kind::solid;
    const Sphere ball = sphere_about(region.corners());
    const Probe center = field_.probe(ball.center, region.nearest);
    region.nearest = center.triangle;
    region.bound = std::min(region.bound, center.deepest(ball.radius));
    if (!solid && center.inside) take(ball.center, center.distance, center.triangle);
    if (!matters(region.bound)) return push(std::move(region));
    field_.find_near(ball, center, near_);
    // the surface search finds maxima on the surface of b
    if (solid) {
      if (field_.rises(region.corners(), ball, near_)) return;
      if (!region.held && is_beside(ball, region.held)) return;
      if (center.inside && improves(center.distance) && (region.held || holds(ball.center)))
        take(ball.center, center.distance, center.triangle);
    }
    tighten(region, ball, center);
    push(std::move(region));
  }

  struct Rows {
    std::array<GameRow, max_game_rows> values;
    std::array<int, max_game_rows> triangles;  // of a; -1: none
    int count = 0;

    bool full() const { return count == max_game_rows; }
    /// returns  true if it is new, and there is space for it
    bool add(const GameRow& row, int triangle) {
      const auto end = triangles.begin() + count;
      if (full() || (triangle >= 0 && std::find(triangles.begin(), end, triangle) != end))
        return false;
      values[count] = row, triangles[count++] = triangle;
      return true;
    }
    GameSolution solve(int columns) const {
      return solve_game({values.data(), static_cast<size_t>(count)}, columns);
    }
  };

  // Lowers the bound by cutting planes at the point where it is attained.
  // source  Kelley (1960), The cutting-plane method
  void tighten(Region& region, const Sphere& ball, const Probe& center) {
    constexpr int max_cuts = 10;
    const std::span<Vector3d> corners = region.corners();
    Rows rows;
    const auto add = [&](int triangle) {
      return rows.add(field_.row(triangle, corners), triangle);
    };
    for (int side = 0; side < 6; ++side) rows.add(field_.box_row(side, corners), -1);
    field_.local_rows(corners, ball, near_, [&](const GameRow& row, int triangle) {
      if (rows.count < max_game_rows / 2) rows.add(row, triangle);
    });
    for (const int triangle : region.triangles)
      if (triangle >= 0) add(triangle);
    add(center.triangle);
    const double first = region.bound;
    for (int cut = 0; cut < max_cuts; ++cut) {
      const GameSolution game = rows.solve(static_cast<int>(corners.size()));
      if (game.value < region.bound) {
        region.bound = game.value;
        keep_triangles(region, game, rows);
      }
      if (!matters(region.bound)) return;
      Vector3d p = Vector3d::Zero();
      for (size_t j = 0; j < corners.size(); ++j) p += game.columns[j] * corners[j];
      const ClosestPoint near = field_.nearest(p, region.nearest);
      bool cuts = false;
      const bool known = region.kind == Region::Kind::surface || region.held;
      if (known || ((b_.convex() || improves(near.distance)) && holds(p))) {
        if (improves(near.distance) && field_.holds(p)) take(p, near.distance, near.triangle);
      } else if (b_.convex()) {
        cuts = rows.add(wall(region, first, p), -1);
      }
      if (near.distance < game.value && add(near.triangle)) cuts = true;
      if (!cuts) return;
    }
  }

  // A row from the plane of the convex b beyond which p lies: no less than the bound in b, and
  // steeply decreasing outside.
  GameRow wall(Region& region, double bound, const Vector3d& p) const {
    constexpr double steep = 1e4;
    const std::span<Vector3d> corners = region.corners();
    GameRow row;
    row.fill(bound);
    const int triangle = closest_point(b_, placement_.to_b(p)).triangle;
    const Slope slope = slope_of(b_, triangle);
    if (slope.error > 1e-8) return row;
    const Vector3d on_plane = b_.mesh().corners(triangle)[0];
    const double per_length = steep * bound / sphere_about(corners).radius;
    const double error = slope.error * b_.radius() + placement_.rounding();
    for (size_t j = 0; j < corners.size(); ++j)
      row[j] += per_length * (slope.inward.dot(placement_.to_b(corners[j]) - on_plane) + error);
    return row;
  }

  static void keep_triangles(Region& region, const GameSolution& game, const Rows& rows) {
    region.triangles.fill(-1);
    size_t kept = 0;
    for (int i = 0; i < rows.count && kept < region.triangles.size(); ++i)
      if (game.rows[i] > 0 && rows.triangles[i] >= 0) region.triangles[kept++] = rows.triangles[i];
  }

  const Shape& b_;
  const DepthField field_;
  const Placement placement_;
  const PenetrationOptions& options_;
  double smallest_;                 // radius of the two [m]
  std::vector<Vector3d> vertices_;  // of b
  std::vector<int> triangles_;      // of b that may be inside a
  std::priority_queue<Region, std::vector<Region>, Deeper> queue_;
  std::vector<Region>* branch_ = nullptr;  // destination of parts instead of the queue
  NearTriangles near_;                     // of the simplex at hand
  int count_ = 0;
  double left_out_ = 0;  // no omitted region is deeper [m]
  Penetration best_;
};

}  // namespace

Penetration penetration(const Shape& a, const Shape& b, const Pose& X_AB,
                        const PenetrationOptions& options) {
  if (!(options.absolute > 0 && options.relative > 0))
    fail("penetration: expected tolerances > 0, got {} and {}", options.absolute, options.relative);
  if (!a.closed() || !colliding(a, b, X_AB)) return {};
  return DeepestPoint(a, b, X_AB, options).find();
}

}  // namespace clench
