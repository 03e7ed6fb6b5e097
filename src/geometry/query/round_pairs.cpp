#include "clench/geometry/query/round_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clench/base/watched.h"
#include "clench/geometry/query/placement.h"

namespace clench {

using Eigen::Vector3d;

static constexpr double no_limit = std::numeric_limits<double>::infinity();
static constexpr double no_distance = 1e-300;  // only what overlaps is nearer

ShapeParts::ShapeParts(const Shape& of, RoundIn where) : shape(&of), facets(&of) {
  if (!of.is_round(where)) return;
  rounds = of.rounds().pieces;
  facets = of.facets().get();
}

std::vector<int> triangles_near(const Shape& piece_of, int piece, const Shape& facets,
                                const Pose& X_FP, double limit) {
  const double reach = limit + core_of(piece_of.rounds().pieces[piece].solid).around;
  std::vector<int> out;
  for (const TrianglePair& pair : pairs_within(facets, piece_of.core(piece), X_FP, reach))
    out.push_back(pair.triangle_a);
  return out;
}

namespace {

// The point of facets nearest to a round piece, in the frame of the facets.
struct FacetPlace : NearPlace {
  int triangle = -1;
};

class FacetQuery {
 public:
  FacetQuery(const Shape& piece_of, int piece, const Shape& facets, const Pose& X_FP)
      : piece_of_(piece_of),
        piece_(piece),
        facets_(facets),
        X_FP_(X_FP),
        round_{piece_of.rounds().pieces[piece].solid, X_FP * piece_of.rounds().pieces[piece].X_SR} {
  }

  /// returns  triangle -1 if nothing is nearer than the limit; distance 0 if the piece's axis
  ///          intersects the facets or lies inside their solid
  FacetPlace nearest_place(double limit) const {
    const double around = core_of(round_.solid).around;
    const Distance core = distance(facets_, piece_of_.core(piece_), X_FP_, limit + around);
    FacetPlace best;
    if (core.distance == 0) {
      best.distance = 0, best.point = core.p_a, best.triangle = std::max(core.triangle_a, 0);
      best.normal = Vector3d::Zero();
      return best;
    }
    if (core.triangle_a < 0) return best;
    offer(core.triangle_a, best);
    if (round_.solid.kind == Round::capsule) {
      if (best.distance >= limit) best.triangle = -1;
      return best;
    }
    const double reach = std::min(limit, best.distance);
    for (const int triangle : triangles_near(piece_of_, piece_, facets_, X_FP_, reach)) {
      check_stop();
      const Corners corners = facets_.mesh().corners(triangle);
      const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
      double size = 0;
      for (const Vector3d& corner : corners) size = std::max(size, (corner - middle).norm());
      if (round_.nearest_to(middle).distance - size < best.distance) offer(triangle, best);
    }
    if (best.distance >= limit) best.triangle = -1;
    return best;
  }

 private:
  void offer(int triangle, FacetPlace& best) const {
    const NearPlace place = nearest_on_triangle(round_, facets_.mesh().corners(triangle));
    if (place.distance < best.distance)
      static_cast<NearPlace&>(best) = place, best.triangle = triangle;
  }
  const Shape& piece_of_;
  int piece_;
  const Shape& facets_;
  Pose X_FP_;
  PlacedRound round_;
};

// Finds the nearest of all pairs of parts of two shapes.
class PartsQuery {
 public:
  PartsQuery(const Shape& a, const Shape& b, const Pose& X_AB, RoundIn where, double limit)
      : a_(a, where), b_(b, where), X_AB_(X_AB), limit_(limit) {
    best_.distance = no_limit;
  }

  Distance find(PairCache* cache) {
    look_at_rounds();
    if (a_.facets && b_.facets) facets(cache);
    return deep_ ? *deep_ : best_;
  }

  bool meet(PairCache* cache) {
    look_at_rounds();
    return deep_ || best_.distance <= 0 ||
           (a_.facets && b_.facets && colliding(*a_.facets, *b_.facets, X_AB_, cache));
  }

 private:
  void look_at_rounds() {
    StopCheck check(64);
    for (size_t i = 0; i < a_.rounds.size(); ++i) {
      for (size_t j = 0; j < b_.rounds.size(); ++j) check(), rounds(i, j);
      if (b_.facets) check(), facets_of_b(i);
    }
    for (size_t j = 0; a_.facets && j < b_.rounds.size(); ++j) check(), facets_of_a(j);
  }

  // Parts that overlap so deeply that no separating displacement is found take precedence over all
  // others.
  // deepest  largest depth that the parts may have
  void offer(const Distance& found, double deepest) {
    if (found.distance <= -deepest || found.distance == 0) {
      if (!deep_) deep_ = found, deep_->distance = 0;
    } else if (found.distance < limit()) {
      best_ = found;
    }
  }

  double limit() const { return std::min(limit_, best_.distance); }

  // Is the distance between two bounding balls at least the distance searched for?
  bool apart(const Vector3d& p, double radius_p, const Vector3d& q, double radius_q) const {
    return (p - q).norm() - radius_p - radius_q >= std::max(limit(), 0.0);
  }
  static double radius_of(const RoundPiece& piece) {
    const Core core = core_of(piece.solid);
    return core.end.norm() + core.around;
  }

  void rounds(size_t i, size_t j) {
    const RoundPiece &a = a_.rounds[i], &b = b_.rounds[j];
    const Pose X_AR = X_AB_ * b.X_SR;
    if (apart(a.X_SR.position, radius_of(a), X_AR.position, radius_of(b))) return;
    const RoundGap gap = gap_between({a.solid, a.X_SR}, {b.solid, X_AR});
    offer({gap.gap, gap.p_a, gap.p_b, a.first, b.first},
          std::min(inner_radius(a.solid), inner_radius(b.solid)));
  }

  void facets_of_b(size_t i) {
    const RoundPiece& a = a_.rounds[i];
    if (apart(a.X_SR.position, radius_of(a), X_AB_ * b_.facets->center(), b_.facets->radius()))
      return;
    const FacetPlace place = FacetQuery(*a_.shape, static_cast<int>(i), *b_.facets, X_AB_.inverse())
                                 .nearest_place(limit());
    if (place.triangle < 0) return;
    offer({place.distance, X_AB_ * Vector3d(place.point - place.distance * place.normal),
           X_AB_ * place.point, a.first, b_.triangle(place.triangle)},
          inner_radius(a.solid));
  }

  void facets_of_a(size_t j) {
    const RoundPiece& b = b_.rounds[j];
    if (apart(a_.facets->center(), a_.facets->radius(), X_AB_ * b.X_SR.position, radius_of(b)))
      return;
    const FacetPlace place =
        FacetQuery(*b_.shape, static_cast<int>(j), *a_.facets, X_AB_).nearest_place(limit());
    if (place.triangle < 0) return;
    offer({place.distance, place.point, place.point - place.distance * place.normal,
           a_.triangle(place.triangle), b.first},
          inner_radius(b.solid));
  }

  void facets(PairCache* cache) {
    const double here = std::max(limit(), 0.0);
    Distance found = distance(*a_.facets, *b_.facets, X_AB_, here, cache);
    found.triangle_a = a_.triangle(found.triangle_a);
    found.triangle_b = b_.triangle(found.triangle_b);
    offer(found, no_limit);
  }

  ShapeParts a_, b_;
  Pose X_AB_;
  double limit_;
  Distance best_;
  std::optional<Distance> deep_;
};

}  // namespace

Distance signed_distance(const Shape& a, const Shape& b, const Pose& X_AB, RoundIn where,
                         double limit, PairCache* cache) {
  return PartsQuery(a, b, checked_pose(X_AB), where, std::max(limit, no_distance)).find(cache);
}

bool colliding_rounds(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache) {
  return PartsQuery(a, b, checked_pose(X_AB), RoundIn::all, no_distance).meet(cache);
}

}  // namespace clench
