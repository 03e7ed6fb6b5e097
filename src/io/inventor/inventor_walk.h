// Traverses a scene graph node by node, and provides the properties that apply to each shape.
#pragma once
#include <functional>
#include <set>

#include "clench/io/inventor/inventor_graph.h"
#include "clench/io/inventor/inventor_matrix.h"

namespace clench {

/// How the color numbers of faces are determined.
enum class ColorBinding { whole, face, corner };

/// Properties set by the nodes before a shape.
struct InventorState {
  InventorMatrix X;
  float unit = 1;  ///< of the last Units node [m]
  const InventorNode* coordinates = nullptr;
  std::span<const float> diffuse = {}, transparency = {};  ///< colors of three numbers
  std::span<const int32_t> packed = {};  ///< colors that take precedence over diffuse
  ColorBinding binding = ColorBinding::whole;
  bool by_parts = false;        ///< true if each side of a round shape or cube has a separate color
  bool colors_indexed = false;  ///< true if colors are given by indices
  bool clockwise = false;
  bool convex = false;  ///< true if the file declares all faces convex
  float complexity = 0.5f;
  int choice = -1;  ///< of the last switch

  Eigen::Vector3f color(int number) const;
  float alpha(int number) const;  ///< transparency
};

/// Sets binding, by_parts and colors_indexed according to the value of a MaterialBinding.
void bind_colors(InventorState& state, const std::string& word);

/// The color of a four-byte number, red in the highest byte.
Eigen::Vector3f unpacked_color(int32_t rgba);

struct InventorWalk {
  int max_visits = 2'000'000;  ///< limit of nodes; shared ones and copies count each time
  /// Limit of indices, colors, heights and spines listed by shapes; shared ones count each time.
  size_t max_listed = 50'000'000;
  /// Called for each shape; its errors receive the place of the shape.
  std::function<void(const InventorNode&, const InventorState&)> shape;
  bool colors_given = false;         ///< out: true if a node with colors was visited
  std::set<std::string> units = {};  ///< out: named by nodes, except METERS
  InventorWarnings warnings = {};    ///< out
};

/// throws Error  "box.iv: expected at most ..." for too many visits or listed numbers, and the
/// errors of `shape`
void walk_inventor(const InventorGraph& graph, const InventorState& start, InventorWalk& walk);

/// Passes all diagnostics of reading and traversing the files to the caller.
void tell_inventor_warnings(const InventorGraph& graph, const InventorWalk& walk,
                            const ReadOptions& options);

}  // namespace clench
