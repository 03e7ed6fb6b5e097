// Queries between shapes with round pieces: these by their formulas, the rest by its triangles.
// Used by the queries of this module, and by dynamics, where more pieces count as round.
#pragma once
#include <span>

#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/round_gap.h"

namespace clench {

/// Has any of the two shapes round pieces that count there?
inline bool are_round(const Shape& a, const Shape& b, RoundIn where) {
  return a.is_round(where) || b.is_round(where);
}

/// A shape as a pair query sees it.
struct ShapeParts {
  ShapeParts(const Shape& shape, RoundIn where);
  const Shape* shape;
  std::span<const RoundPiece> rounds;
  const Shape* facets;  ///< the other triangles; null if there are none

  /// The index in the shape's mesh of a triangle of `facets`.
  int triangle(int facet) const {
    return rounds.empty() || facet < 0 ? facet : shape->facet(facet);
  }
};

/// distance(), but negative where a round piece lies in the other shape by less than its inner
/// radius: minus the depth [m], at p_a and p_b, each of which then lies in the other shape. 0 where
/// the shapes overlap otherwise. A round piece is named by its first triangle.
Distance signed_distance(const Shape& a, const Shape& b, const Pose& X_AB, RoundIn where,
                         double limit = std::numeric_limits<double>::infinity(),
                         PairCache* cache = nullptr);

/// colliding() of shapes of which one at least has round pieces everywhere.
bool colliding_rounds(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache = nullptr);

/// Triangles of `facets` that may come as near to a round piece as `limit` [m], in index order.
/// piece_of  shape with the round piece
/// X_FP      the frame of that shape in the frame of the facets
std::vector<int> triangles_near(const Shape& piece_of, int piece, const Shape& facets,
                                const Pose& X_FP, double limit);

}  // namespace clench
