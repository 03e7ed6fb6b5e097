#include "clench/contact/round_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "clench/base/watched.h"
#include "clench/contact/near_surface.h"

namespace clench {

using Eigen::Vector3d;

namespace {

// The flat part of a placed solid along a direction, in the frame that the solid is placed in.
struct PlacedFlat {
  FlatPart part;

  PlacedFlat(const PlacedRound& round, const Vector3d& direction, double slack)
      : part(flat_part(round.solid, round.X.rotation.conjugate() * direction, slack)) {
    part.middle = round.X * part.middle;
    for (Vector3d* v : {&part.half, &part.x, &part.y}) *v = round.X.rotation * *v;
  }

  // The point of the flat part straight above or below p, along its normal.
  Vector3d above(const Vector3d& p) const {
    const Vector3d from = p - part.middle;
    if (part.kind == FlatPart::segment)
      return part.middle +
             std::clamp(from.dot(part.half) / part.half.squaredNorm(), -1.0, 1.0) * part.half;
    if (part.kind == FlatPart::disc)
      return part.middle +
             (from.dot(part.x) * part.x + from.dot(part.y) * part.y) / part.x.squaredNorm();
    return part.middle;
  }
  // does p lie over the disc, along its normal?
  bool over_disc(const Vector3d& p) const {
    const Vector3d from = p - part.middle;
    return std::hypot(from.dot(part.x), from.dot(part.y)) <= part.x.squaredNorm();
  }
  // The part of the line p + s way over the disc, or abreast of the flat segment: from s = low to
  // high.
  // returns  false where the line misses it
  bool clip(const Vector3d& p, const Vector3d& way, double& low, double& high) const {
    const Vector3d from = p - part.middle;
    if (part.kind == FlatPart::disc) {
      const double size = part.x.squaredNorm();
      const double fx = from.dot(part.x) / size, fy = from.dot(part.y) / size,
                   wx = way.dot(part.x) / size, wy = way.dot(part.y) / size;
      const double a = wx * wx + wy * wy, b = fx * wx + fy * wy, c = fx * fx + fy * fy - 1;
      const double under = b * b - a * c;
      if (!(a > 0) || under < 0) return false;
      low = (-b - std::sqrt(under)) / a, high = (-b + std::sqrt(under)) / a;
      return true;
    }
    const double size = part.half.squaredNorm(), speed = way.dot(part.half) / size,
                 at = from.dot(part.half) / size;
    if (std::abs(speed) * std::sqrt(size) < 0.5 * way.norm()) return false;
    low = (-1 - at) / speed, high = (1 - at) / speed;
    if (low > high) std::swap(low, high);
    return true;
  }
};

// Near points of a mesh and a round solid.
class MeshPoints {
 public:
  MeshPoints(const PlacedRound& round, const Shape& mesh, const std::vector<int>& near,
             double threshold)
      : round_(round),
        closed_(mesh.closed()),
        facing_(closed_ && mesh.solid().volume < 0 ? -1 : 1),
        threshold_(threshold),
        deepest_(-inner_radius(round.solid)),
        near_(near),
        surface_(mesh.mesh(), near, Pose()) {}

  std::vector<NearPoint> find() {
    StopCheck check(64);
    for (int i = 0; i < static_cast<int>(near_.size()); ++i) check(), face(i);
    for (int i = 0; i < surface_.edge_count(); ++i) check(), edge(i);
    for (int i = 0; i < surface_.corner_count(); ++i) check(), corner(i);
    return std::move(out_);
  }

 private:
  bool is_near(double gap) const { return gap < threshold_ && gap > deepest_; }

  void add(const Vector3d& on_mesh, const Vector3d& normal, double gap, const Feature& feature) {
    if (is_near(gap))
      out_.push_back({.p_a = on_mesh,
                      .p_b = on_mesh + gap * normal,
                      .normal = normal,
                      .gap = gap,
                      .feature_a = feature,
                      .feature_b = {}});
  }

  void face(int i) {
    const Corners& c = surface_.corners(i);
    Vector3d normal = facing_ * face_normal(c);
    if (normal.isZero()) return;
    if (!closed_ && normal.dot(round_.centre() - c[0]) < 0) normal = -normal;
    const PlacedFlat flat(round_, -normal, threshold_);
    const Feature feature{Feature::triangle, near_[i], -1};
    const auto add_place = [&](const Vector3d& place) {
      const double gap = normal.dot(place - c[0]);
      add(place - gap * normal, normal, gap, feature);
    };
    std::array<Vector3d, 3> inward;
    for (int k = 0; k < 3; ++k) {
      inward[k] = face_normal(c).cross(c[(k + 1) % 3] - c[k]).stableNormalized();
    }
    const double size =
        std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
    const double on_border = 1e-9 * size;
    const auto inside = [&](const Vector3d& p) {
      for (int k = 0; k < 3; ++k)
        if (inward[k].dot(p - c[k]) < -on_border) return false;
      return true;
    };
    if (flat.part.kind == FlatPart::point) {
      if (inside(flat.part.middle)) add_place(flat.part.middle);
    } else if (flat.part.kind == FlatPart::segment) {
      double low = -1, high = 1;
      for (int k = 0; k < 3; ++k) {
        const double at = inward[k].dot(flat.part.middle - c[k]) + on_border,
                     speed = inward[k].dot(flat.part.half);
        if (speed > 0) low = std::max(low, -at / speed);
        if (speed < 0) high = std::min(high, -at / speed);
        if (speed == 0 && at < 0) return;
      }
      if (low > high) return;
      add_place(flat.part.middle + low * flat.part.half);
      add_place(flat.part.middle + high * flat.part.half);
    } else {
      constexpr int rim_points = 8;
      for (int k = 0; k < rim_points; ++k) {
        const double angle = 2 * std::numbers::pi * k / rim_points;
        const Vector3d rim =
            flat.part.middle + std::cos(angle) * flat.part.x + std::sin(angle) * flat.part.y;
        if (inside(rim)) add_place(rim);
      }
      for (int k = 0; k < 3; ++k) {
        if (flat.over_disc(c[k])) add_place(flat.above(c[k]));
        const Vector3d way = c[(k + 1) % 3] - c[k];
        double low, high;
        if (!flat.clip(c[k], way, low, high)) continue;
        for (const double s : {low, high})
          if (s > 0 && s < 1) add_place(flat.above(c[k] + s * way));
      }
    }
  }

  void edge(int i) {
    const auto slots = surface_.at_edge(i);
    const Corners& c = surface_.corners(slots[0] / 3);
    const Vector3d &p = c[slots[0] % 3], way = c[(slots[0] % 3 + 1) % 3] - p;
    const double length = way.norm();
    if (!(length > 0)) return;
    const NearPlace place = nearest_on_segment(round_, p, p + way);
    if (!is_near(place.distance)) return;
    const Vector3d normal = -place.normal, along = way / length;
    // the solid must lie over the edge, not over a face beside it
    constexpr double level = 1e-9;
    for (const int slot : slots) {
      const Corners& t = surface_.corners(slot / 3);
      const Vector3d third = t[(slot % 3 + 2) % 3] - p;
      const Vector3d inward = third - third.dot(along) * along;
      if (normal.dot(inward) > level * inward.norm()) return;
    }
    const Feature feature = surface_.edge_feature(i);
    const double at = (place.point - p).dot(along) / length;
    // a nearest point at an end belongs to the corner there, unless the edge runs along the solid
    constexpr double at_end = 1e-9, beside = 1e-6;
    if (at > at_end && at < 1 - at_end)
      add(place.point, normal, place.distance, feature);
    else if (std::abs(normal.dot(along)) > beside)
      return;
    const PlacedFlat flat(round_, -normal, threshold_);
    double low, high;
    if (flat.part.kind == FlatPart::point || !flat.clip(p, way, low, high)) return;
    for (const double s : {std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0)}) {
      const NearPlace end = round_.nearest_to(p + s * way);
      constexpr double one_normal = 1 - 1e-6;
      if (end.normal.dot(place.normal) > one_normal) add(end.point, normal, end.distance, feature);
    }
  }

  void corner(int i) {
    const auto slots = surface_.at_corner(i);
    const Vector3d& p = surface_.corners(slots[0] / 3)[slots[0] % 3];
    const NearPlace place = round_.nearest_to(p);
    if (!is_near(place.distance)) return;
    constexpr double level = 1e-9;
    for (const int slot : slots) {
      const Corners& t = surface_.corners(slot / 3);
      for (int k = 1; k < 3; ++k) {
        const Vector3d way = t[(slot % 3 + k) % 3] - p;
        if (-place.normal.dot(way) > level * way.norm()) return;
      }
    }
    add(p, -place.normal, place.distance, surface_.vertex_feature(i));
  }

  PlacedRound round_;
  bool closed_;
  double facing_, threshold_, deepest_;
  const std::vector<int>& near_;
  NearSurface surface_;
  std::vector<NearPoint> out_;
};

// Point of the first disc where the rims of two discs that lie on each other cross.
// side  -1 or 1: which of the two crossings
std::optional<Vector3d> rims_cross(const FlatPart& a, const FlatPart& b, double side) {
  const double x = (b.middle - a.middle).dot(a.x), y = (b.middle - a.middle).dot(a.y);
  const double r2 = a.x.squaredNorm(), r = std::sqrt(r2), d = std::hypot(x, y) / r;
  if (!(d > 0)) return std::nullopt;
  const double along = (d * d + r2 - b.x.squaredNorm()) / (2 * d), squared = r2 - along * along;
  if (squared < 0) return std::nullopt;
  const double across = side * std::sqrt(squared);
  // in the disc's plane, of length 1 / r: towards the other's middle, and across
  const Vector3d to = (x * a.x + y * a.y) / (r2 * d * r), left = (x * a.y - y * a.x) / (r2 * d * r);
  return a.middle + r * (along * to + across * left);
}

}  // namespace

std::vector<NearPoint> near_points_of_mesh(const PlacedRound& round, const Shape& mesh,
                                           const std::vector<int>& near, double threshold) {
  if (near.empty()) return {};
  return MeshPoints(round, mesh, near, threshold).find();
}

std::vector<NearPoint> near_points_of_rounds(const PlacedRound& a, const PlacedRound& b,
                                             double threshold) {
  const RoundGap nearest = gap_between(a, b);
  if (!(nearest.gap < threshold) ||
      nearest.gap <= -std::min(inner_radius(a.solid), inner_radius(b.solid)))
    return {};
  std::vector<NearPoint> out;
  const Vector3d& n = nearest.normal;
  out.push_back({.p_a = nearest.p_a,
                 .p_b = nearest.p_b,
                 .normal = n,
                 .gap = nearest.gap,
                 .feature_a = {},
                 .feature_b = {}});
  const PlacedFlat on_a(a, n, threshold), on_b(b, -n, threshold);
  if (on_a.part.kind == FlatPart::point || on_b.part.kind == FlatPart::point) return out;
  // Adds p, on one flat part, if the other solid is near in the same direction.
  const auto add = [&](const Vector3d& p, const PlacedRound& other, bool of_a) {
    const NearPlace place = other.nearest_to(p);
    constexpr double one_normal = 1 - 1e-6;
    const Vector3d normal = of_a ? Vector3d(-place.normal) : place.normal;
    if (!(place.distance < threshold) || normal.dot(n) < one_normal) return;
    const Vector3d q = p - place.distance * place.normal;
    out.push_back({.p_a = of_a ? p : q,
                   .p_b = of_a ? q : p,
                   .normal = n,
                   .gap = place.distance,
                   .feature_a = {},
                   .feature_b = {}});
  };
  const auto add_of = [&](const PlacedFlat& flat, const PlacedFlat& cut, const PlacedRound& other,
                          bool of_a) {
    if (flat.part.kind == FlatPart::segment) {
      double low = -1, high = 1;
      const Vector3d from = flat.part.middle - flat.part.half, way = 2 * flat.part.half;
      if (!cut.clip(from, way, low, high)) return;
      for (const double s : {std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0)})
        add(from + s * way, other, of_a);
      return;
    }
    // the rim, where it lies over the other part
    constexpr int count = 16;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      add(flat.part.middle + std::cos(angle) * flat.part.x + std::sin(angle) * flat.part.y, other,
          of_a);
    }
  };
  add_of(on_a, on_b, b, true);
  add_of(on_b, on_a, a, false);
  if (on_a.part.kind == FlatPart::disc && on_b.part.kind == FlatPart::disc)
    for (const double side : {-1.0, 1.0})
      if (const auto p = rims_cross(on_a.part, on_b.part, side)) add(*p, b, true);
  return out;
}

}  // namespace clench
