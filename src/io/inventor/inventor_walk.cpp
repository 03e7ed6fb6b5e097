#include "clench/io/inventor/inventor_walk.h"

#include <algorithm>

#include "clench/base/error.h"

namespace clench {

namespace {

using K = InventorKind;

/// [m]
float length_of_unit(std::string_view name) {
  constexpr std::pair<std::string_view, float> lengths[] = {
      {"METERS", 1.0f},       {"CENTIMETERS", 1e-2f},     {"MILLIMETERS", 1e-3f},
      {"MICROMETERS", 1e-6f}, {"MICRONS", 1e-6f},         {"NANOMETERS", 1e-9f},
      {"ANGSTROMS", 1e-10f},  {"KILOMETERS", 1e3f},       {"FEET", 0.3048f},
      {"INCHES", 0.0254f},    {"POINTS", 0.00035277775f}, {"YARDS", 0.9144f},
      {"MILES", 1609.3f},     {"NAUTICAL_MILES", 1852.0f}};
  return std::ranges::find(lengths, name, &std::pair<std::string_view, float>::first)->second;
}

/// Rotation about x, y or z.
InventorMatrix turn_about(const std::string& axis, float angle) {
  return InventorMatrix::rotation(std::array<float, 4>{
      axis == "X" ? 1.0f : 0.0f, axis == "Y" ? 1.0f : 0.0f, axis == "Z" ? 1.0f : 0.0f, angle});
}

InventorMatrix matrix_from(std::span<const float> sixteen) {
  InventorMatrix out;
  for (int i = 0; i < 16; ++i) out.m[i / 4][i % 4] = sixteen[i];
  return out;
}

/// Count of numbers listed directly in a node. Points are excluded: they take no time until an
/// index refers to them.
size_t listed_by(const InventorNode& node) {
  size_t count = 0;
  for (const auto& [field, value] : node.values)
    if (field->name != "point" && field->name != "vertex")
      count += std::visit([](const auto& list) { return list.size(); }, value);
  return count;
}

class InventorWalker {
 public:
  InventorWalker(const InventorGraph& graph, InventorWalk& walk) : graph_(graph), walk_(walk) {}
  void visit(const InventorNode& node, InventorState& state);

 private:
  void count_visit(const InventorNode& node);
  void count_listed(const InventorNode& shape);
  void visit_children(const InventorNode& node, InventorState& state);
  void visit_apart(const InventorNode& node, InventorState state) { visit_children(node, state); }
  void visit_choice(const InventorNode& node, InventorState& state);
  void visit_array(const InventorNode& node, const InventorState& state);
  void visit_copies(const InventorNode& node, const InventorState& state);
  void visit_shape(const InventorNode& node, InventorState state);
  void set_units(const InventorNode& node, InventorState& state);
  void set_material(const InventorNode& node, InventorState& state);
  /// returns  true if the node transforms those after it
  bool transform(const InventorNode& node, InventorState& state);
  bool set_property(const InventorNode& node, InventorState& state);

  const InventorGraph& graph_;
  InventorWalk& walk_;
  int visits_ = 0;
  size_t listed_ = 0;
};

void InventorWalker::count_visit(const InventorNode& node) {
  if (++visits_ > walk_.max_visits)
    fail("{}: expected at most {} nodes, shared ones counted each time", graph_.place(node),
         walk_.max_visits);
}

// data that gives no triangles takes time, too
void InventorWalker::count_listed(const InventorNode& shape) {
  listed_ += listed_by(shape);
  for (const auto& [field, value] : shape.values)
    if (const auto* nodes = std::get_if<std::vector<const InventorNode*>>(&value))
      for (const auto* below : *nodes) listed_ += listed_by(*below);
  if (listed_ > walk_.max_listed)
    fail("expected shapes that list at most {} numbers, shared ones counted each time",
         walk_.max_listed);
}

void InventorWalker::visit_children(const InventorNode& node, InventorState& state) {
  for (const auto* child : node.children) visit(*child, state);
}

void InventorWalker::visit(const InventorNode& node, InventorState& state) {
  count_visit(node);
  switch (node.type->kind) {
    case K::group:
    case K::include:
      return visit_children(node, state);
    case K::separator:
      return visit_apart(node, state);
    case K::transform_separator: {
      const InventorMatrix X = state.X;
      visit_children(node, state);
      state.X = X;
      return;
    }
    case K::vrml_transform: {
      InventorState inside = state;
      inside.X = InventorMatrix::transform(node.numbers("translation"), node.numbers("rotation"),
                                           node.numbers("scale"), node.numbers("scaleOrientation"),
                                           node.numbers("center")) *
                 state.X;
      return visit_children(node, inside);
    }
    case K::switching:
      return visit_choice(node, state);
    case K::detail:
      if (!node.children.empty()) visit(*node.children[0], state);
      return;
    case K::array:
      return visit_array(node, state);
    case K::copies:
      return visit_copies(node, state);
    case K::vrml_shape: {
      InventorState inside = state;
      if (const auto* appearance = node.node("appearance")) visit(*appearance, inside);
      if (const auto* geometry = node.node("geometry")) visit(*geometry, inside);
      return;
    }
    case K::appearance:
      if (const auto* material = node.node("material")) visit(*material, state);
      return;
    default:
      if (node.type->is_shape())
        visit_shape(node, state);
      else if (!transform(node, state))
        set_property(node, state);
  }
}

void InventorWalker::visit_choice(const InventorNode& node, InventorState& state) {
  constexpr int inherited = -2, all = -3;
  const int own = node.integer(node.type->fields[0].name);
  if (own != inherited) state.choice = own;
  const int choice = state.choice, count = static_cast<int>(node.children.size());
  if (choice == all)
    visit_children(node, state);
  else if (choice >= 0 && choice < count)
    visit(*node.children[choice], state);
}

// a switch inside copy i that inherits its choice selects child i
void InventorWalker::visit_array(const InventorNode& node, const InventorState& state) {
  const int counts[] = {node.integer("numElements1"), node.integer("numElements2"),
                        node.integer("numElements3")};
  if (std::ranges::min(counts) <= 0) return;  // otherwise empty rows could repeat without limit
  const auto &first = node.numbers("separation1"), &second = node.numbers("separation2"),
             &third = node.numbers("separation3");
  const std::string& origin = node.word("origin");
  const auto step = [&](int axis, int i) {
    if (origin == "LAST") return static_cast<float>(-i);
    const float center = origin == "CENTER" ? static_cast<float>(counts[axis] - 1) * 0.5f : 0.0f;
    return static_cast<float>(i) - center;
  };
  for (int k = 0; k < counts[2]; ++k)
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i) {
        count_visit(node);
        InventorVector at;
        for (int x = 0; x < 3; ++x)
          at[x] = third[x] * step(2, k) + second[x] * step(1, j) + first[x] * step(0, i);
        InventorState inside = state;
        inside.X = InventorMatrix::translation(at) * state.X;
        inside.choice = i + counts[0] * (j + counts[1] * k);
        visit_children(node, inside);
      }
}

void InventorWalker::visit_copies(const InventorNode& node, const InventorState& state) {
  const std::span<const float> matrices = node.numbers("matrix");
  for (size_t i = 0; i < matrices.size(); i += 16) {
    count_visit(node);
    InventorState inside = state;
    inside.X = matrix_from(matrices.subspan(i, 16)) * state.X;
    inside.choice = static_cast<int>(i / 16);
    visit_children(node, inside);
  }
}

void InventorWalker::visit_shape(const InventorNode& node, InventorState state) {
  visit_children(node, state);
  try {
    count_listed(node);
    walk_.shape(node, state);
  } catch (const Error& error) {
    fail(error.kind(), "{}: {}", graph_.place(node), error.what());
  }
}

bool InventorWalker::transform(const InventorNode& node, InventorState& state) {
  const auto move = [&](const InventorMatrix& X) { state.X = X * state.X; };
  switch (node.type->kind) {
    case K::translation:
      move(InventorMatrix::translation(node.numbers("translation")));
      return true;
    case K::rotation:
      move(InventorMatrix::rotation(node.numbers("rotation")));
      return true;
    case K::rotation_xyz:
      move(turn_about(node.word("axis"), node.number("angle")));
      return true;
    case K::scale:
      move(InventorMatrix::scale(node.numbers("scaleFactor")));
      return true;
    case K::transform:
      move(InventorMatrix::transform(node.numbers("translation"), node.numbers("rotation"),
                                     node.numbers("scaleFactor"), node.numbers("scaleOrientation"),
                                     node.numbers("center")));
      return true;
    case K::matrix:
      move(matrix_from(node.numbers("matrix")));
      return true;
    case K::units:
      set_units(node, state);
      return true;
    case K::reset:
      for (const auto& what : node.words("whatToReset"))
        if (what == "TRANSFORM") state.X = {};
      return true;
    default:
      return false;
  }
}

void InventorWalker::set_units(const InventorNode& node, InventorState& state) {
  const std::string& name = node.word("units");
  if (name != "METERS") walk_.units.insert(name);  // which is the default
  const float unit = length_of_unit(name), factor = unit / state.unit;
  state.unit = unit;
  state.X = InventorMatrix::scale(std::array<float, 3>{factor, factor, factor}) * state.X;
}

void InventorWalker::set_material(const InventorNode& node, InventorState& state) {
  const std::span<const float> diffuse = node.numbers("diffuseColor"),
                               transparency = node.numbers("transparency");
  if (!diffuse.empty()) state.diffuse = diffuse, state.packed = {};
  if (!transparency.empty()) state.transparency = transparency;
}

bool InventorWalker::set_property(const InventorNode& node, InventorState& state) {
  switch (node.type->kind) {
    case K::material:
      set_material(node, state);
      return walk_.colors_given = true;
    case K::base_color:
      if (!node.numbers("rgb").empty()) state.diffuse = node.numbers("rgb"), state.packed = {};
      return walk_.colors_given = true;
    case K::packed_color:
      if (!node.integers("orderedRGBA").empty()) state.packed = node.integers("orderedRGBA");
      return walk_.colors_given = true;
    case K::binding:
      bind_colors(state, node.word("value"));
      return true;
    case K::hints:
      state.clockwise = node.word("vertexOrdering") == "CLOCKWISE";
      state.convex = node.word("faceType") == "CONVEX";
      // if both are given, the later fields of Inventor 2 are ignored: files of version 1 do not
      // have them
      if (const auto& old = node.words("hints"); !old.empty())
        state.clockwise = false, state.convex = std::ranges::count(old, "CONVEX") > 0;
      return true;
    case K::coordinates:
      state.coordinates = &node;
      return true;
    case K::complexity:
      state.complexity = node.number("value");
      if (node.word("type") != "OBJECT_SPACE")
        walk_.warnings.add(graph_.files[0],
                           {graph_.place(node).of("Complexity"),
                            fmt::format("{} is read as OBJECT_SPACE", node.word("type"))});
      return true;
    default:
      return false;
  }
}

}  // namespace

Eigen::Vector3f unpacked_color(int32_t rgba) {
  const auto bits = static_cast<uint32_t>(rgba);
  const auto byte = [&](int shift) { return static_cast<float>((bits >> shift) & 255) / 255.0f; };
  return {byte(24), byte(16), byte(8)};
}

void bind_colors(InventorState& state, const std::string& word) {
  const bool part = word.starts_with("PER_PART"), face = word.starts_with("PER_FACE");
  state.binding = word.starts_with("PER_VERTEX") ? ColorBinding::corner
                  : part || face                 ? ColorBinding::face
                                                 : ColorBinding::whole;
  state.by_parts = part;
  state.colors_indexed = word.ends_with("INDEXED");
}

Eigen::Vector3f InventorState::color(int number) const {
  const auto at = [&](size_t count) { return std::clamp(number, 0, static_cast<int>(count) - 1); };
  if (!packed.empty()) return unpacked_color(packed[at(packed.size())]);
  if (diffuse.empty()) return {0.8f, 0.8f, 0.8f};
  return Eigen::Vector3f(diffuse.data() + 3 * at(diffuse.size() / 3));
}

float InventorState::alpha(int number) const {
  const auto at = [&](size_t count) { return std::clamp(number, 0, static_cast<int>(count) - 1); };
  if (!packed.empty()) {
    const auto bits = static_cast<uint32_t>(packed[at(packed.size())]);
    return 1.0f - static_cast<float>(bits & 255) / 255.0f;
  }
  return transparency.empty() ? 0.0f : transparency[at(transparency.size())];
}

void walk_inventor(const InventorGraph& graph, const InventorState& start, InventorWalk& walk) {
  InventorState state = start;
  InventorWalker(graph, walk).visit(*graph.root, state);
}

void tell_inventor_warnings(const InventorGraph& graph, const InventorWalk& walk,
                            const ReadOptions& options) {
  for (const Diagnostic& one : graph.repairs.list()) options.diagnostics.repaired(one);
  if (!options.diagnostics) return;
  for (const Diagnostic& one : graph.warnings.list()) options.diagnostics.warn(one);
  for (const Diagnostic& one : walk.warnings.list()) options.diagnostics.warn(one);
}

}  // namespace clench
