#include "clench/contact/near_points.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "clench/base/disjoint_sets.h"
#include "clench/base/watched.h"
#include "clench/contact/near_surface.h"

namespace clench {

using Eigen::Vector3d;

// below this multiple of rounding the difference of two points defines no direction: at this length
// the direction is off by 1e-6
static constexpr double direction_floor = 1e6;

double coordinate_rounding(const Shape& a, const Shape& b, const Pose& X_AB) {
  const auto reach = [](const Shape& s) { return s.center().norm() + s.radius(); };
  return std::numeric_limits<double>::epsilon() * (reach(a) + reach(b) + X_AB.position.norm());
}

Vector3d face_normal(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).stableNormalized();
}

namespace {

// a negative volume means that the triangles face inwards
double facing(const Shape& shape) { return shape.closed() && shape.solid().volume < 0 ? -1 : 1; }

// near crossed edges, and the pair of triangles in which they were found
struct Crossing {
  int edge_a, edge_b, pair;
  Vector3d p_a, p_b;
  double gap;
};

class Collector {
 public:
  Collector(const Shape& a, const Shape& b, const Pose& X_AB,
            const std::vector<TrianglePair>& pairs, double threshold)
      : pairs_(pairs),
        threshold_(threshold),
        rounding_(coordinate_rounding(a, b, X_AB)),
        facing_a_(facing(a)),
        facing_b_(facing(b)),
        a_(a.mesh(), numbers(pairs, &TrianglePair::triangle_a), Pose()),
        b_(b.mesh(), numbers(pairs, &TrianglePair::triangle_b), X_AB),
        regions_(pairs.size()),
        seen_a_(a_.corner_count(), -1),
        seen_b_(b_.corner_count(), -1) {}

  std::vector<NearPoint> collect() {
    add_closest();
    StopCheck check(256);
    for (int pair = 0; pair < static_cast<int>(pairs_.size()); ++pair) {
      check();
      i_ = a_.find(pairs_[pair].triangle_a), j_ = b_.find(pairs_[pair].triangle_b);
      for (int k = 0; k < 3; ++k) corner_of_a(pair, k);
      for (int k = 0; k < 3; ++k) corner_of_b(pair, k);
      for (int k = 0; k < 9; ++k) edges(pair, k / 3, k % 3);
    }
    add_crossings();
    add_lost_regions();
    for (NearPoint& point : points_) {
      point.region = regions_.find(point.region);
      point.gap = std::max(point.gap, points_[0].gap);  // closer by rounding only
    }
    return std::move(points_);
  }

 private:
  static std::vector<int> numbers(const std::vector<TrianglePair>& pairs, int TrianglePair::*side) {
    std::vector<int> out;
    for (const TrianglePair& pair : pairs) out.push_back(pair.*side);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  // From a into b: along the gap if it is wide enough to define a direction, otherwise along
  // `face`, a normal in either sense, otherwise between the triangles' normals.
  Vector3d normal(const Vector3d& p_a, const Vector3d& p_b, double gap, int i, int j,
                  const Vector3d& face) const {
    if (gap > direction_floor * rounding_) return (p_b - p_a).normalized();
    const Vector3d between =
        facing_a_ * face_normal(a_.corners(i)) - facing_b_ * face_normal(b_.corners(j));
    Vector3d n = face.stableNormalized();
    if (n.isZero()) n = between.stableNormalized();
    if (n.isZero()) n = Vector3d::UnitZ();
    return n.dot(between) < 0 ? Vector3d(-n) : n;
  }

  void add_pair(int pair) {
    const TrianglePair& p = pairs_[pair];
    const int i = a_.find(p.triangle_a), j = b_.find(p.triangle_b);
    const bool on_face_b = b_.around(j, p.p_b).empty();
    const Vector3d face = face_normal(on_face_b ? b_.corners(j) : a_.corners(i));
    points_.push_back({p.p_a, p.p_b, normal(p.p_a, p.p_b, p.distance, i, j, face), p.distance,
                       a_.feature(i, p.p_a), b_.feature(j, p.p_b), pair});
  }

  static bool nearer(const TrianglePair& p, const TrianglePair& q) {
    return p.distance < q.distance;
  }

  void add_closest() {
    const auto closest = std::min_element(pairs_.begin(), pairs_.end(), nearer);
    add_pair(static_cast<int>(closest - pairs_.begin()));
    if (closest->distance <= direction_floor * rounding_) take_normal_of_faces();
  }

  // If the gap defines no direction, only rounding decides which pair is the closest: two faces
  // that lie on each other, if there are any, define it.
  void take_normal_of_faces() {
    NearPoint& closest = points_.front();
    for (const TrianglePair& p : pairs_) {
      if (p.distance > closest.gap + rounding_) continue;
      const Vector3d n_a = facing_a_ * face_normal(a_.corners(a_.find(p.triangle_a))),
                     n_b = facing_b_ * face_normal(b_.corners(b_.find(p.triangle_b)));
      constexpr double parallel = 1 - 1e-9;
      if (n_a.dot(n_b) < -parallel) {
        closest.normal = n_a;
        return;
      }
    }
  }

  void corner_of_a(int pair, int k) {
    const int corner = a_.corner(i_, k);
    const Vector3d& p = a_.corners(i_)[k];
    const Closest c = point_triangle(p, b_.corners(j_));
    if (!(c.distance < threshold_)) return;
    meet(seen_a_[corner], pair);
    // the first triangle at the corner represents all
    const auto slots = a_.at_corner(corner);
    if (slots[0] != 3 * i_ + k) return;
    const Vector3d n = normal(p, c.q, c.distance, i_, j_, face_normal(b_.corners(j_)));
    if (a_.is_summit(slots, p, n, threshold_, rounding_) &&
        b_.is_summit(b_.around(j_, c.q), c.q, -n, threshold_, rounding_))
      points_.push_back(
          {p, c.q, n, c.distance, a_.vertex_feature(corner), b_.feature(j_, c.q), pair});
  }

  void corner_of_b(int pair, int k) {
    const int corner = b_.corner(j_, k);
    const Vector3d& q = b_.corners(j_)[k];
    const Closest c = point_triangle(q, a_.corners(i_));
    if (!(c.distance < threshold_)) return;
    meet(seen_b_[corner], pair);
    const auto slots = b_.at_corner(corner);
    if (slots[0] != 3 * j_ + k) return;
    const Vector3d n = normal(c.q, q, c.distance, i_, j_, face_normal(a_.corners(i_)));
    if (b_.is_summit(slots, q, -n, threshold_, rounding_) &&
        a_.is_summit(a_.around(i_, c.q), c.q, n, threshold_, rounding_))
      points_.push_back(
          {c.q, q, n, c.distance, a_.feature(i_, c.q), b_.vertex_feature(corner), pair});
  }

  void meet(int& seen, int pair) {
    if (seen < 0) seen = pair;
    regions_.join(seen, pair);
  }

  // edges whose nearest points are interior to both; ends are corners
  void edges(int pair, int k, int l) {
    const Corners &ca = a_.corners(i_), &cb = b_.corners(j_);
    const Vector3d &a0 = ca[k], &a1 = ca[(k + 1) % 3], &b0 = cb[l], &b1 = cb[(l + 1) % 3];
    const Closest c = segment_segment(a0, a1, b0, b1);
    if (!(c.distance < threshold_)) return;
    const auto inside = [](const Vector3d& p, const Vector3d& from, const Vector3d& to) {
      const double end = 1e-9 * (to - from).norm();
      return (p - from).norm() > end && (p - to).norm() > end;
    };
    if (inside(c.p, a0, a1) && inside(c.q, b0, b1))
      crossings_.push_back({a_.edge(i_, k), b_.edge(j_, l), pair, c.p, c.q, c.distance});
  }

  void add_crossings() {
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& x, const Crossing& y) {
      return std::tie(x.edge_a, x.edge_b, x.pair) < std::tie(y.edge_a, y.edge_b, y.pair);
    });
    for (size_t first = 0, next; first < crossings_.size(); first = next) {
      const Crossing& c = crossings_[first];
      for (next = first + 1; next < crossings_.size() && crossings_[next].edge_a == c.edge_a &&
                             crossings_[next].edge_b == c.edge_b;
           ++next)
        regions_.join(c.pair, crossings_[next].pair);
      add_crossing(c);
    }
  }

  void add_crossing(const Crossing& c) {
    const auto slots_a = a_.at_edge(c.edge_a), slots_b = b_.at_edge(c.edge_b);
    const auto along = [](const NearSurface& s, int slot) {
      const Corners& corners = s.corners(slot / 3);
      return Vector3d(corners[(slot + 1) % 3] - corners[slot % 3]);
    };
    const Vector3d across = along(a_, slots_a[0]).cross(along(b_, slots_b[0]));
    const Vector3d n = normal(c.p_a, c.p_b, c.gap, a_.find(pairs_[c.pair].triangle_a),
                              b_.find(pairs_[c.pair].triangle_b), across);
    if (a_.is_summit(slots_a, c.p_a, n, threshold_, rounding_) &&
        b_.is_summit(slots_b, c.p_b, -n, threshold_, rounding_))
      points_.push_back(
          {c.p_a, c.p_b, n, c.gap, a_.edge_feature(c.edge_a), b_.edge_feature(c.edge_b), c.pair});
  }

  // every region has at least its closest pair
  void add_lost_regions() {
    std::vector<char> found(pairs_.size(), 0);
    for (const NearPoint& point : points_) found[regions_.find(point.region)] = 1;
    std::vector<int> closest(pairs_.size(), -1);
    for (int pair = 0; pair < static_cast<int>(pairs_.size()); ++pair) {
      int& best = closest[regions_.find(pair)];
      if (best < 0 || nearer(pairs_[pair], pairs_[best])) best = pair;
    }
    for (size_t region = 0; region < closest.size(); ++region)
      if (closest[region] >= 0 && !found[region]) add_pair(closest[region]);
  }

  const std::vector<TrianglePair>& pairs_;
  double threshold_, rounding_, facing_a_, facing_b_;
  NearSurface a_, b_;
  DisjointSets regions_;              // of pairs that share a near corner or near crossed edges
  std::vector<int> seen_a_, seen_b_;  // first pair in which a corner was near
  std::vector<Crossing> crossings_;
  std::vector<NearPoint> points_;
  int i_ = 0, j_ = 0;  // the pair's triangles, by their numbers in the near surfaces
};

}  // namespace

std::vector<NearPoint> near_points(const Shape& a, const Shape& b, const Pose& X_AB,
                                   const std::vector<TrianglePair>& pairs, double threshold) {
  return Collector(a, b, X_AB, pairs, threshold).collect();
}

}  // namespace clench
