// Queries between shapes with round pieces: closed formulas for these, triangles for the rest. Used
// by the queries of this module, and by dynamics, where more pieces count as round.
#pragma once
#include <span>

#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/round_gap.h"

namespace clench {

/// True if one of the shapes has pieces that are treated as round for the purpose `where`.
inline bool are_round(const Shape& a, const Shape& b, RoundIn where) {
  return a.is_round(where) || b.is_round(where);
}

/// A shape as used by a pair query.
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

/// distance(), but negative if a round piece penetrates the other shape by less than its inner
/// radius: minus the depth [m], at p_a and p_b, each of which then lies in the other shape. 0 for
/// any other overlap. A round piece is identified by its first triangle.
Distance signed_distance(const Shape& a, const Shape& b, const Pose& X_AB, RoundIn where,
                         double limit = std::numeric_limits<double>::infinity(),
                         PairCache* cache = nullptr);

/// colliding() of shapes at least one of which has round pieces of RoundIn::all.
bool colliding_rounds(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache = nullptr);

/// Triangles of `facets` that may be within `limit` [m] of a round piece, in index order.
/// piece_of  shape with the round piece
/// X_FP      the frame of that shape in the frame of the facets
std::vector<int> triangles_near(const Shape& piece_of, int piece, const Shape& facets,
                                const Pose& X_FP, double limit);

}  // namespace clench
