#include "clench/contact/round_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clench/base/watched.h"
#include "clench/contact/near_surface.h"
#include "clench/contact/placed_flat.h"

namespace clench {

using Eigen::Vector3d;

namespace {

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
    if (!closed_ && normal.dot(round_.center() - c[0]) < 0) normal = -normal;
    const Vector3d farthest = round_.farthest(-normal);
    const double least = normal.dot(farthest - c[0]);
    if (!is_near(least)) return;
    const PlacedFlat flat(round_, -normal, threshold_ - std::max(least, 0.0));
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
      // the ball at the end of a tilted capsule reaches a little farther than its side
      if (round_.solid.kind == Round::capsule && normal.dot(flat.part.half) != 0 &&
          inside(farthest))
        add_place(farthest);
      double low = flat.part.low, high = flat.part.high;
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
      for (const Vector3d& rim : flat.rim(rim_points))
        if (inside(rim)) add_place(rim);
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
    // the solid must be over the edge, not over a face beside it
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
    const PlacedFlat flat(round_, -normal, std::numeric_limits<double>::infinity());
    double low, high;
    if (flat.part.kind == FlatPart::point || !flat.clip(p, way, low, high)) return;
    const auto near =
        near_part(std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0), at, flat.alignment(way),
                  threshold_, [&](double s) { return round_.nearest_to(p + s * way).distance; });
    if (!near) return;
    for (const double s : {near->first, near->second}) {
      const NearPlace end = round_.nearest_to(p + s * way);
      constexpr double one_normal = 1 - 1e-9;
      const bool same = end.normal.dot(place.normal) > one_normal;
      add(end.point, same ? normal : Vector3d(-end.normal), end.distance, feature);
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

}  // namespace

std::vector<NearPoint> near_points_of_mesh(const PlacedRound& round, const Shape& mesh,
                                           const std::vector<int>& near, double threshold) {
  if (near.empty()) return {};
  return MeshPoints(round, mesh, near, threshold).find();
}

}  // namespace clench
