#include "clench/contact/round_touches.h"

#include <algorithm>

#include "clench/contact/facet_touches.h"
#include "clench/contact/patches.h"
#include "clench/contact/round_points.h"

namespace clench {

using Eigen::Vector3d;

namespace {

// Contact points of all pairs of parts of two shapes: round pieces, and the other triangles.
class RoundTouches {
 public:
  RoundTouches(const Shape& a, const Shape& b, const Pose& X_AB, RoundIn where,
               const TouchOptions& options)
      : a_(a, where),
        b_(b, where),
        X_AB_(X_AB),
        options_(options),
        merge_(merge_radius(a, b, options)),
        rounding_(std::max(64 * coordinate_rounding(a, b, X_AB),
                           1e-9 * std::min(a.radius(), b.radius()))) {}

  std::vector<Touch> find() {
    for (int i = 0; i < static_cast<int>(a_.rounds.size()); ++i) {
      for (int j = 0; j < static_cast<int>(b_.rounds.size()); ++j) rounds(i, j);
      if (b_.facets) facets_of_b(i);
    }
    for (int j = 0; a_.facets && j < static_cast<int>(b_.rounds.size()); ++j) facets_of_a(j);
    if (a_.facets && b_.facets) facets();
    return std::move(touches_);
  }

 private:
  static Feature piece(int number) { return {Feature::round, number, -1}; }
  // A feature of the facets, by the indices of the complete mesh.
  static Feature named(const ShapeParts& parts, Feature feature) {
    if (parts.rounds.empty()) return feature;
    if (feature.kind == Feature::triangle) {
      feature.first = parts.shape->facet(feature.first);
    } else if (feature.kind != Feature::round) {
      feature.first = parts.shape->facet_vertex(feature.first);
      if (feature.second >= 0) feature.second = parts.shape->facet_vertex(feature.second);
    }
    return feature;
  }

  // Keeps a touch unless another pair of parts has given the same one, with no larger gap.
  // before  number of touches of the other pairs
  void keep(const Touch& touch, size_t before) {
    const auto same = [&](const Touch& other) {
      return (other.p_a - touch.p_a).norm() < merge_ &&
             other.normal_b.dot(touch.normal_b) > same_normal && other.gap <= touch.gap;
    };
    if (std::none_of(touches_.begin(), touches_.begin() + static_cast<std::ptrdiff_t>(before),
                     same))
      touches_.push_back(touch);
  }

  void keep_corners(std::vector<NearPoint> points, bool swapped) {
    if (points.empty()) return;
    const size_t before = touches_.size();
    for (const int i :
         patch_corners(points, std::max(merge_, rounding_), options_.max_per_patch, rounding_)) {
      const NearPoint& p = points[i];
      keep(swapped ? Touch{X_AB_ * p.p_b, X_AB_ * p.p_a, X_AB_.rotation * Vector3d(-p.normal),
                           p.gap, p.feature_b, p.feature_a}
                   : Touch{p.p_a, p.p_b, p.normal, p.gap, p.feature_a, p.feature_b},
           before);
    }
  }

  void rounds(int i, int j) {
    const RoundPiece &a = a_.rounds[i], &b = b_.rounds[j];
    auto points =
        near_points_of_rounds({a.solid, a.X_SR}, {b.solid, X_AB_ * b.X_SR}, options_.threshold);
    for (NearPoint& p : points) p.feature_a = piece(i), p.feature_b = piece(j);
    keep_corners(std::move(points), false);
  }

  void facets_of_a(int j) {
    const RoundPiece& b = b_.rounds[j];
    const auto near = triangles_near(*b_.shape, j, *a_.facets, X_AB_, options_.threshold);
    auto points =
        near_points_of_mesh({b.solid, X_AB_ * b.X_SR}, *a_.facets, near, options_.threshold);
    for (NearPoint& p : points) p.feature_a = named(a_, p.feature_a), p.feature_b = piece(j);
    keep_corners(std::move(points), false);
  }

  void facets_of_b(int i) {
    const RoundPiece& a = a_.rounds[i];
    const Pose X_BA = X_AB_.inverse();
    const auto near = triangles_near(*a_.shape, i, *b_.facets, X_BA, options_.threshold);
    auto points =
        near_points_of_mesh({a.solid, X_BA * a.X_SR}, *b_.facets, near, options_.threshold);
    for (NearPoint& p : points) p.feature_a = named(b_, p.feature_a), p.feature_b = piece(i);
    keep_corners(std::move(points), true);
  }

  void facets() {
    const size_t before = touches_.size();
    for (Touch touch : facet_contact_set(*a_.facets, *b_.facets, X_AB_, options_)) {
      touch.feature_a = named(a_, touch.feature_a), touch.feature_b = named(b_, touch.feature_b);
      keep(touch, before);
    }
  }

  ShapeParts a_, b_;
  Pose X_AB_;
  TouchOptions options_;
  double merge_, rounding_;
  std::vector<Touch> touches_;
};

}  // namespace

std::vector<Touch> round_contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                                     RoundIn where, const TouchOptions& options) {
  return RoundTouches(a, b, X_AB, where, options).find();
}

}  // namespace clench
