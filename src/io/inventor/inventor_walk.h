// The way through a scene graph, node by node, and what holds at each shape.
#pragma once
#include <functional>
#include <set>

#include "clench/io/inventor/inventor_graph.h"
#include "clench/io/inventor/inventor_matrix.h"

namespace clench {

/// Where a face's color number comes from.
enum class ColorBinding { whole, face, corner };

/// What the nodes before a shape have set.
struct InventorState {
  InventorMatrix X;
  float unit = 1;  ///< of the last Units node [m]
  const InventorNode* coordinates = nullptr;
  std::span<const float> diffuse = {}, transparency = {};  ///< colors of three numbers
  std::span<const int32_t> packed = {};                    ///< colors that go before diffuse
  ColorBinding binding = ColorBinding::whole;
  bool by_parts = false;        ///< has each side of a round shape or cube its color?
  bool colors_indexed = false;  ///< do indices name the colors?
  bool clockwise = false;
  bool convex = false;  ///< does the file say that all faces are?
  float complexity = 0.5f;
  int choice = -1;  ///< of the last switch

  Eigen::Vector3f color(int number) const;
  float alpha(int number) const;  ///< transparency
};

/// Sets binding, by_parts and colors_indexed by the word of a MaterialBinding.
void bind_colors(InventorState& state, const std::string& word);

/// A number of a color of four bytes, red first.
Eigen::Vector3f unpacked_color(int32_t rgba);

struct InventorWalk {
  int max_visits = 2'000'000;  ///< nodes, shared ones and copies each time
  /// Indices, colors, heights and spines that shapes list, shared ones each time.
  size_t max_listed = 50'000'000;
  /// Called at each shape; what it throws gets the place of the shape.
  std::function<void(const InventorNode&, const InventorState&)> shape;
  bool colors_given = false;         ///< out: was a node of colors passed?
  std::set<std::string> units = {};  ///< out: named by nodes, METERS left out
  InventorWarnings warnings = {};    ///< out
};

/// throws Error  "box.iv: expected at most ..." of visits or of what shapes list, and what
/// `shape` throws
void walk_inventor(const InventorGraph& graph, const InventorState& start, InventorWalk& walk);

/// Tells the listeners of all that was found on the way, and of what reading the files found.
void tell_inventor_warnings(const InventorGraph& graph, const InventorWalk& walk,
                            const ReadOptions& options);

}  // namespace clench
