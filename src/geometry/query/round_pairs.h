// Queries between shapes of which some pieces are round: these by their formulas, the rest by its
// triangles. For the queries of this module, and for dynamics, where more counts as round.
#pragma once
#include <span>

#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/round_gap.h"

namespace clench {

/// Has one of them round pieces there?
inline bool are_round(const Shape& a, const Shape& b, RoundIn where) {
  return a.is_round(where) || b.is_round(where);
}

/// A shape as a pair query sees it.
struct ShapeParts {
  ShapeParts(const Shape& shape, RoundIn where);
  const Shape* shape;
  std::span<const RoundPiece> rounds;
  const Shape* facets;  ///< the other triangles; null without any

  int triangle(int facet) const {
    return rounds.empty() || facet < 0 ? facet : shape->facet(facet);
  }
};

/// distance(), but negative where a round piece lies in the other shape by less than its inner
/// radius: how deep it does, at p_a and p_b, which then lie in the other one [m]. 0 where they
/// overlap otherwise. A round piece is named by its first triangle.
Distance signed_distance(const Shape& a, const Shape& b, const Pose& X_AB, RoundIn where,
                         double limit = std::numeric_limits<double>::infinity(),
                         PairCache* cache = nullptr);

/// colliding() of shapes of which one at least has round pieces everywhere.
bool colliding_rounds(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache = nullptr);

/// Triangles that may come as near to a round piece as `limit` [m], in index order, of a shape in
/// whose frame the piece stands.
/// X_SP  the frame of the piece's shape in that of the triangles
std::vector<int> triangles_near(const Shape& piece_of, int piece, const Shape& facets,
                                const Pose& X_SP, double limit);

}  // namespace clench
