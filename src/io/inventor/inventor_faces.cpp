#include "clench/io/inventor/inventor_faces.h"

#include "clench/base/error.h"

namespace clench {

namespace {

using K = InventorKind;

class FaceLister {
 public:
  FaceLister(const InventorNode& shape, InventorSurface& surface)
      : shape_(shape), surface_(surface) {}

  void take_points(const InventorState& state);
  void take_vrml_points();
  void list_indexed(const std::vector<int32_t>& color_indices);
  void list_counted();
  void list_grid(int64_t rows, int64_t columns, int64_t start);
  void list_heights();

 private:
  template <class... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(fmt::format("{}: ", shape_.type->name) +
                fmt::format(format, std::forward<Args>(args)...));
  }
  /// the node of that type in a field; null if there is none
  const InventorNode* part(const char* field, std::string_view type) const;
  void set_points(std::span<const float> numbers, int width);
  InventorVector point(int i) const;
  bool swaps() const { return shape_.type->name == "IndexedTriangleMesh"; }
  bool strips() const { return shape_.type->name.ends_with("StripSet") || swaps(); }
  void add(std::span<const int> corners, int color);

  const InventorNode& shape_;
  InventorSurface& surface_;
  std::span<const float> numbers_;
  int width_ = 3, point_count_ = 0;
  ColorBinding binding_ = ColorBinding::whole;
  bool indexed_ = false;  // true if colors are given by indices
  std::vector<InventorVector> corners_;
};

const InventorNode* FaceLister::part(const char* field, std::string_view type) const {
  const InventorNode* node = shape_.node(field);
  if (node && node->type->name != type)
    refuse("{}: expected a {}, got {}", field, type, node->type->name);
  return node;
}

void FaceLister::set_points(std::span<const float> numbers, int width) {
  numbers_ = numbers;
  width_ = width;
  point_count_ = static_cast<int>(numbers.size()) / width;
}

InventorVector FaceLister::point(int i) const {
  const float* p = &numbers_[static_cast<size_t>(i) * width_];
  if (width_ == 4) return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  return {p[0], p[1], p[2]};
}

void FaceLister::take_points(const InventorState& state) {
  surface_.clockwise = state.clockwise;
  surface_.convex = state.convex;
  InventorState bound = state;
  static constexpr std::array<float, 3> origin = {};  // default if there are no points
  set_points(origin, 3);
  if (state.coordinates)
    set_points(state.coordinates->numbers("point"),
               state.coordinates->type->name == "Coordinate4" ? 4 : 3);
  if (const InventorNode* own = part("vertexProperty", "VertexProperty")) {
    if (!own->numbers("vertex").empty()) set_points(own->numbers("vertex"), 3);
    for (const int32_t rgba : own->integers("orderedRGBA"))
      surface_.colors.push_back(unpacked_color(rgba));
    if (!surface_.colors.empty()) bind_colors(bound, own->word("materialBinding"));
  }
  binding_ = bound.binding;
  indexed_ = bound.colors_indexed;
}

void FaceLister::take_vrml_points() {
  surface_.clockwise = !shape_.integer("ccw");
  if (const InventorNode* points = part("coord", "Coordinate"))
    set_points(points->numbers("point"), 3);
  const InventorNode* color = shape_.node("color");
  if (!color || color->type->name != "Color") return;
  const std::span<const float> numbers = color->numbers("color");
  for (size_t i = 0; i < numbers.size(); i += 3) surface_.colors.emplace_back(&numbers[i]);
  binding_ = shape_.integer("colorPerVertex") ? ColorBinding::corner : ColorBinding::face;
  indexed_ = binding_ == ColorBinding::corner || !shape_.integers("colorIndex").empty();
}

void FaceLister::add(std::span<const int> corners, int color) {
  // the orientation of triangles in a strip alternates
  const size_t step = strips() ? 3 : corners.size();
  for (size_t i = 0; i + 2 < corners.size() && i + step <= corners.size(); ++i) {
    corners_.clear();
    for (size_t k = 0; k < step; ++k) corners_.push_back(point(corners[i + k]));
    // a swap repeats a corner
    if (swaps() && (corners[i] == corners[i + 2] || corners[i + 1] == corners[i + 2])) continue;
    if (strips() && i % 2 == 1) std::swap(corners_[0], corners_[1]);
    surface_.add(corners_, color);
  }
}

void FaceLister::list_indexed(const std::vector<int32_t>& color_indices) {
  const auto& indices = shape_.integers("coordIndex");
  const bool own_indices = indexed_ && !color_indices.empty() && color_indices[0] >= 0;
  const auto color_at = [&](size_t i) { return i < color_indices.size() ? color_indices[i] : 0; };
  std::vector<int> face;
  int color = 0, corners = 0, faces = 0;
  for (size_t i = 0; i <= indices.size(); ++i) {
    const int index = i < indices.size() ? indices[i] : -1;
    if (index == -1) {
      add(face, color);
      face.clear();
      ++faces;
      continue;
    }
    if (index == -2 && swaps() && face.size() >= 2) {
      face.push_back(face[face.size() - 2]);
      continue;
    }
    if (index < 0 || index >= point_count_)
      refuse("number {} of coordIndex: expected -1 or one of {} points, got {}", i, point_count_,
             index);
    // a face has the color of its first corner
    if (face.empty() && binding_ == ColorBinding::face)
      color = own_indices ? color_at(faces) : faces;
    if (face.empty() && binding_ == ColorBinding::corner)
      color = own_indices ? color_at(i) : indexed_ ? index : corners;
    face.push_back(index);
    ++corners;
  }
}

void FaceLister::list_counted() {
  const auto& counts = shape_.integers("numVertices");
  const int start = shape_.integer("startIndex");
  if (start < 0) refuse("startIndex: expected a number from 0, got {}", start);
  int64_t used = start;
  std::vector<int> face;
  for (size_t i = 0; i < counts.size(); ++i) {
    // -1: all remaining
    const int64_t count = counts[i] == -1 ? std::max<int64_t>(0, point_count_ - used) : counts[i];
    if (counts[i] != -1 && count < 3)
      refuse("number {} of numVertices: expected at least 3, got {}", i, counts[i]);
    if (used + count > point_count_)
      refuse("number {} of numVertices: expected {} points, got {}", i, used + count, point_count_);
    face.clear();
    for (int64_t k = 0; k < count; ++k) face.push_back(static_cast<int>(used + k));
    add(face, binding_ == ColorBinding::face     ? static_cast<int>(i)
              : binding_ == ColorBinding::corner ? static_cast<int>(used) - start
                                                 : 0);
    used += count;
  }
}

void FaceLister::list_grid(int64_t rows, int64_t columns, int64_t start) {
  if (rows < 2 || columns < 2 || start < 0 || rows > point_count_ || columns > point_count_ ||
      start + rows * columns > point_count_)
    refuse("expected {} x {} points from {} on, got {}", rows, columns, start, point_count_);
  for (int64_t r = 0; r + 1 < rows; ++r)
    for (int64_t c = 0; c + 1 < columns; ++c) {
      const int p = static_cast<int>(start + r * columns + c),
                below = static_cast<int>(p + columns);
      add(std::array{p, below, below + 1, p + 1}, 0);
    }
}

void FaceLister::list_heights() {
  const auto& heights = shape_.numbers("height");
  const int64_t x = shape_.integer("xDimension"), z = shape_.integer("zDimension"),
                count = static_cast<int64_t>(heights.size());
  if (x < 0 || z < 0 || x > count || z > count || x * z > count)
    refuse("expected {} x {} heights, got {}", x, z, count);
  surface_.clockwise = !shape_.integer("ccw");
  if (x < 2 || z < 2) return;
  std::vector<float> points;
  for (int64_t i = 0; i < x * z; ++i)
    points.insert(points.end(), {static_cast<float>(i % x) * shape_.number("xSpacing"), heights[i],
                                 static_cast<float>(i / x) * shape_.number("zSpacing")});
  set_points(points, 3);
  list_grid(z, x, 0);
}

}  // namespace

bool list_faces(const InventorNode& shape, const InventorState& state, InventorSurface& surface) {
  FaceLister lister(shape, surface);
  switch (shape.type->kind) {
    case K::indexed_faces:
      lister.take_points(state);
      lister.list_indexed(shape.integers("materialIndex"));
      return true;
    case K::listed_faces:
      lister.take_points(state);
      lister.list_counted();
      return true;
    case K::quad_mesh:
      lister.take_points(state);
      lister.list_grid(shape.integer("verticesPerColumn"), shape.integer("verticesPerRow"),
                       shape.integer("startIndex"));
      return true;
    case K::vrml_faces:
      lister.take_vrml_points();
      lister.list_indexed(shape.integers("colorIndex"));
      return true;
    case K::heights:
      lister.list_heights();
      return true;
    default:
      return false;
  }
}

}  // namespace clench
