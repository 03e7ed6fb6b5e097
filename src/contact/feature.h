// Features: the part of a mesh on which a contact lies, by which it is recognized in the next step.
#pragma once
#include <compare>

namespace clench {

/// A vertex, an edge between two vertices, or a triangle, by their indices in the mesh; or a round
/// piece, by its index in Shape::rounds(). Equal features of one shape are the same part, whatever
/// the pose of the shape. Vertices that coincide but are not shared in the file have different
/// indices; the lowest of those nearby represents them.
struct Feature {
  enum Kind { vertex, edge, triangle, round };
  Kind kind = triangle;
  int first = -1;   ///< the vertex, the edge's lower vertex, the triangle or the piece
  int second = -1;  ///< the edge's higher vertex; otherwise -1

  auto operator<=>(const Feature&) const = default;
};

}  // namespace clench
