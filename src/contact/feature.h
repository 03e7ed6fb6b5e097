// Which part of a mesh a contact lies on, so that it is known again in the next step.
#pragma once
#include <compare>

namespace clench {

/// A vertex, an edge between two vertices, or a triangle, by their indices in the mesh; or a round
/// piece, by its index in Shape::rounds(). Equal features of one shape are the same part, however
/// the shape stands; vertices at one place that a file does not share have an index each, and the
/// lowest that is near stands for them.
struct Feature {
  enum Kind { vertex, edge, triangle, round };
  Kind kind = triangle;
  int first = -1;   ///< the vertex, the edge's lower vertex, the triangle or the piece
  int second = -1;  ///< the edge's higher vertex; else -1

  auto operator<=>(const Feature&) const = default;
};

}  // namespace clench
