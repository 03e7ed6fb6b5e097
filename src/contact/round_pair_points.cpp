// Near points of two round solids.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "clench/contact/placed_flat.h"
#include "clench/contact/round_points.h"

namespace clench {

using Eigen::Vector3d;

namespace {

constexpr double all_of_it = std::numeric_limits<double>::infinity();

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

// Computes the near points of two solids in addition to the nearest ones.
class PairPoints {
 public:
  PairPoints(const PlacedRound& a, const PlacedRound& b, const RoundGap& nearest, double threshold)
      : a_(a),
        b_(b),
        nearest_(nearest),
        threshold_(threshold),
        on_a_(a, nearest.normal, all_of_it),
        on_b_(b, -nearest.normal, all_of_it) {}

  std::vector<NearPoint> find() {
    out_.push_back({.p_a = nearest_.p_a,
                    .p_b = nearest_.p_b,
                    .normal = nearest_.normal,
                    .gap = nearest_.gap,
                    .feature_a = {},
                    .feature_b = {}});
    const auto kind_a = on_a_.part.kind, kind_b = on_b_.part.kind;
    if (kind_a == FlatPart::point || kind_b == FlatPart::point) return std::move(out_);
    if (kind_a == FlatPart::disc && kind_b == FlatPart::disc) {
      discs();
    } else {
      if (kind_a == FlatPart::segment) line(true);
      if (kind_b == FlatPart::segment) line(false);
    }
    return std::move(out_);
  }

 private:
  // Adds the nearest points of p, which lies on the surface of one solid, and of the other solid.
  // limit  largest gap [m]
  void add(const Vector3d& p, bool of_a, double limit) {
    const NearPlace place = (of_a ? b_ : a_).nearest_to(p);
    constexpr double one_way = 0.9, one_normal = 1 - 1e-9;
    const Vector3d normal = of_a ? Vector3d(-place.normal) : place.normal;
    const double cosine = normal.dot(nearest_.normal);
    if (!(place.distance < limit) || cosine < one_way) return;
    const Vector3d q = p - place.distance * place.normal;
    out_.push_back({.p_a = of_a ? p : q,
                    .p_b = of_a ? q : p,
                    .normal = cosine > one_normal ? nearest_.normal : normal,
                    .gap = place.distance,
                    .feature_a = {},
                    .feature_b = {}});
  }

  // The ends of the line along which the side of one solid is near a flat part of the other: the
  // distance of the other from the axis is convex along it.
  void line(bool of_a) {
    const PlacedRound &round = of_a ? a_ : b_, &other = of_a ? b_ : a_;
    const PlacedFlat &flat = of_a ? on_a_ : on_b_, &cut = of_a ? on_b_ : on_a_;
    const Vector3d from = flat.part.middle - flat.part.half, way = 2 * flat.part.half;
    double low, high;
    if (!cut.clip(from, way, low, high)) return;
    const Vector3d start = round.X.position - flat.part.half;
    const auto nearest_of_other = [&](double s) { return other.nearest_to(start + s * way); };
    const Vector3d& p = of_a ? nearest_.p_a : nearest_.p_b;
    const auto near =
        near_part(std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0),
                  (p - start).dot(way) / way.squaredNorm(), cut.alignment(way), threshold_,
                  [&](double s) { return nearest_of_other(s).distance - round.solid.radii.x(); });
    if (!near) return;
    for (const double s : {near->first, near->second}) {
      const NearPlace place = nearest_of_other(s);
      add(place.point - place.distance * place.normal, !of_a, threshold_);
    }
  }

  // The outline of the area that two caps share, as far as it is near.
  void discs() {
    const auto outward = [](const PlacedFlat& flat) {
      const Vector3d axis = flat.part.x.cross(flat.part.y);
      return Vector3d(axis.normalized());
    };
    const auto up = [&](const PlacedFlat& flat, const Vector3d& n) {
      const Vector3d axis = outward(flat);
      return axis.dot(n) < 0 ? Vector3d(-axis) : axis;
    };
    const Vector3d up_a = up(on_a_, nearest_.normal), up_b = up(on_b_, -nearest_.normal);
    // the farthest points of each towards the other's plane
    on_a_ = PlacedFlat(a_, -up_b, all_of_it), on_b_ = PlacedFlat(b_, -up_a, all_of_it);
    const double tilt = up_a.cross(up_b).norm(), slack = threshold_ - std::max(nearest_.gap, 0.0);
    const double drop = 2 * tilt * std::min(a_.solid.radii.x(), b_.solid.radii.x());
    const double height = near_height(slack, drop);
    if (!(height > 0)) return;
    const double limit = height < drop ? nearest_.gap + height : threshold_;
    for (const bool of_a : {true, false}) {
      PlacedFlat flat = of_a ? on_a_ : on_b_;
      const PlacedFlat& other = of_a ? on_b_ : on_a_;
      const Vector3d& up_other = of_a ? up_b : up_a;
      const double lowest = up_other.dot(flat.part.middle + flat.part.x - other.part.middle);
      if (height < drop) flat.part.cut = 1 - (limit - lowest) / (tilt * flat.part.x.norm());
      if (flat.part.cut >= 1) continue;
      flat.part.cut = std::max(flat.part.cut, -1.0);
      constexpr int count = 16;
      for (const Vector3d& p : flat.rim(count))
        if (other.over_disc(p)) add(p, of_a, threshold_);
    }
    for (const double side : {-1.0, 1.0})
      if (const auto p = rims_cross(on_a_.part, on_b_.part, side)) add(*p, true, limit);
  }

  PlacedRound a_, b_;
  RoundGap nearest_;
  double threshold_;
  PlacedFlat on_a_, on_b_;
  std::vector<NearPoint> out_;
};

}  // namespace

std::vector<NearPoint> near_points_of_rounds(const PlacedRound& a, const PlacedRound& b,
                                             double threshold) {
  const RoundGap nearest = gap_between(a, b);
  if (!(nearest.gap < threshold) ||
      nearest.gap <= -std::min(inner_radius(a.solid), inner_radius(b.solid)))
    return {};
  return PairPoints(a, b, nearest, threshold).find();
}

}  // namespace clench
