#include "io/inventor_faces.h"

#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/elements/SoCoordinateElement.h>
#include <Inventor/nodes/SoFaceSet.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoIndexedTriangleStripSet.h>
#include <Inventor/nodes/SoQuadMesh.h>
#include <Inventor/nodes/SoTriangleStripSet.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include "base/error.h"

namespace clench {

namespace {

/// Where a face's colour number comes from.
enum class Binding { whole, face, corner };

class FaceReader {
 public:
  explicit FaceReader(const SoNode* node) : name_(node_name(node)) {}

  void take_points(SoCallbackAction* action, SoVertexShape* shape);
  void take_points(SoNode* coordinate);
  void read_indexed(const SoMFInt32& indices, const SoMFInt32& color_indices, bool strips);
  void read_listed(const SoMFInt32& counts, int start, bool strips);
  void read_grid(long long rows, long long columns, long long start);
  void read_heights(SoVRMLElevationGrid* grid);
  void bind_colors(SoVRMLIndexedFaceSet* shape);

  FaceList out;
  Binding binding = Binding::whole;
  bool indexed = false;

 private:
  template <class... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(name_ + ": " + fmt::format(format, std::forward<Args>(args)...));
  }
  void add_face(const std::vector<int>& points, int color);
  void add_strip(const std::vector<int>& points, int color);

  std::string name_;
  int faces_ = 0;  // faces or strips seen so far
};

void FaceReader::take_points(SoCallbackAction* action, SoVertexShape* shape) {
  int kind = action->getMaterialBinding();
  out.clockwise = action->getVertexOrdering() == SoShapeHints::CLOCKWISE;
  out.convex = action->getFaceType() == SoShapeHints::CONVEX;
  const SoCoordinateElement* state = SoCoordinateElement::getInstance(action->getState());
  out.point_count = state->getNum();
  out.point = [state](int i) { return state->get3(i); };
  if (SoNode* node = shape->vertexProperty.getValue()) {
    if (!node->isOfType(SoVertexProperty::getClassTypeId()))
      refuse("vertexProperty: wanted a VertexProperty, got {}", node_name(node));
    auto* property = static_cast<SoVertexProperty*>(node);
    if (property->vertex.getNum() > 0) {
      out.point_count = property->vertex.getNum();
      out.point = [property](int i) { return property->vertex[i]; };
    }
    for (int i = 0; i < property->orderedRGBA.getNum(); ++i) {
      float transparency = 0;
      out.colors.push_back(SbColor().setPackedValue(property->orderedRGBA[i], transparency));
    }
    if (!out.colors.empty()) kind = property->materialBinding.getValue();
  }
  using B = SoMaterialBinding;
  if (kind == B::PER_VERTEX || kind == B::PER_VERTEX_INDEXED)
    binding = Binding::corner;
  else if (kind != B::OVERALL)
    binding = Binding::face;
  indexed =
      kind == B::PER_VERTEX_INDEXED || kind == B::PER_FACE_INDEXED || kind == B::PER_PART_INDEXED;
}

void FaceReader::take_points(SoNode* coordinate) {
  out.point_count = 0;
  if (!coordinate) return;
  if (!coordinate->isOfType(SoVRMLCoordinate::getClassTypeId()))
    refuse("coord: wanted a Coordinate, got {}", node_name(coordinate));
  auto* points = static_cast<SoVRMLCoordinate*>(coordinate);
  out.point_count = points->point.getNum();
  out.point = [points](int i) { return points->point[i]; };
}

void FaceReader::add_face(const std::vector<int>& points, int color) {
  if (points.size() < 3) return;
  out.faces.push_back(
      {static_cast<int>(out.corners.size()), static_cast<int>(points.size()), color});
  out.corners.insert(out.corners.end(), points.begin(), points.end());
}

void FaceReader::add_strip(const std::vector<int>& points, int color) {
  // every other triangle of a strip turns the other way
  for (size_t i = 0; i + 2 < points.size(); ++i)
    add_face(i % 2 == 0 ? std::vector<int>{points[i], points[i + 1], points[i + 2]}
                        : std::vector<int>{points[i + 1], points[i], points[i + 2]},
             color);
}

void FaceReader::read_indexed(const SoMFInt32& indices, const SoMFInt32& color_indices,
                              bool strips) {
  const bool own_indices = indexed && color_indices.getNum() > 0 && color_indices[0] >= 0;
  const auto color_at = [&](int i) { return i < color_indices.getNum() ? color_indices[i] : 0; };
  std::vector<int> points;
  int color = 0, corners = 0;
  const auto finish = [&] {
    if (strips)
      add_strip(points, color);
    else
      add_face(points, color);
    points.clear();
    ++faces_;
  };
  for (int i = 0; i < indices.getNum(); ++i) {
    const int index = indices[i];
    if (index == -1) {
      finish();
      continue;
    }
    if (index < 0 || index >= out.point_count)
      refuse("number {} of coordIndex: wanted -1 or one of {} points, got {}", i, out.point_count,
             index);
    // a face has the colour of its first corner
    if (points.empty()) {
      if (binding == Binding::face) color = own_indices ? color_at(faces_) : faces_;
      if (binding == Binding::corner) color = own_indices ? color_at(i) : indexed ? index : corners;
    }
    points.push_back(index);
    ++corners;
  }
  if (!points.empty()) finish();
}

void FaceReader::read_listed(const SoMFInt32& counts, int start, bool strips) {
  if (start < 0) refuse("startIndex: wanted a number from 0, got {}", start);
  long long used = start;
  for (int i = 0; i < counts.getNum(); ++i) {
    // -1: all that are left
    const long long count = counts[i] == -1 ? std::max(0LL, out.point_count - used) : counts[i];
    if (count < 0 || (count < 3 && counts[i] != -1))
      refuse("number {} of numVertices: wanted at least 3, got {}", i, counts[i]);
    if (used + count > out.point_count)
      refuse("number {} of numVertices: wanted {} points, got {}", i, used + count,
             out.point_count);
    std::vector<int> points;
    for (long long k = 0; k < count; ++k) points.push_back(static_cast<int>(used + k));
    const int color = binding == Binding::face     ? i
                      : binding == Binding::corner ? static_cast<int>(used) - start
                                                   : 0;
    if (strips)
      add_strip(points, color);
    else
      add_face(points, color);
    used += count;
  }
}

void FaceReader::read_grid(long long rows, long long columns, long long start) {
  if (rows < 2 || columns < 2 || start < 0 || rows > out.point_count || columns > out.point_count ||
      start + rows * columns > out.point_count)
    refuse("wanted {} x {} points from {} on, got {}", rows, columns, start, out.point_count);
  for (long long r = 0; r + 1 < rows; ++r)
    for (long long c = 0; c + 1 < columns; ++c) {
      const int p = static_cast<int>(start + r * columns + c),
                below = static_cast<int>(p + columns);
      add_face({p, below, below + 1, p + 1}, 0);
    }
}

void FaceReader::read_heights(SoVRMLElevationGrid* grid) {
  const long long x = grid->xDimension.getValue(), z = grid->zDimension.getValue(),
                  heights = grid->height.getNum();
  if (x < 0 || z < 0 || x > heights || z > heights || x * z > heights)
    refuse("wanted {} x {} heights, got {}", x, z, heights);
  out.point_count = static_cast<int>(x * z);
  out.point = [grid, x](int i) {
    return SbVec3f(static_cast<float>(i % x) * grid->xSpacing.getValue(), grid->height[i],
                   static_cast<float>(i / x) * grid->zSpacing.getValue());
  };
  out.clockwise = !grid->ccw.getValue();
  if (x >= 2 && z >= 2) read_grid(z, x, 0);
}

void FaceReader::bind_colors(SoVRMLIndexedFaceSet* shape) {
  SoNode* color = shape->color.getValue();
  if (!color || !color->isOfType(SoVRMLColor::getClassTypeId())) return;
  const auto& colors = static_cast<SoVRMLColor*>(color)->color;
  for (int i = 0; i < colors.getNum(); ++i) out.colors.push_back(SbColor(colors[i]));
  binding = shape->colorPerVertex.getValue() ? Binding::corner : Binding::face;
  indexed = binding == Binding::corner || shape->colorIndex.getNum() > 0;
}

}  // namespace

std::string node_name(const SoNode* node) {
  const std::string name = node->getTypeId().getName().getString();
  return name.starts_with("VRML") ? name.substr(4) : name;
}

std::optional<FaceList> list_faces(SoCallbackAction* action, SoNode* shape) {
  const auto is = [&](SoType type) { return shape->isOfType(type); };
  FaceReader reader(shape);
  if (is(SoVRMLIndexedFaceSet::getClassTypeId())) {
    auto* faces = static_cast<SoVRMLIndexedFaceSet*>(shape);
    reader.take_points(faces->coord.getValue());
    reader.bind_colors(faces);
    reader.out.clockwise = !faces->ccw.getValue();
    reader.read_indexed(faces->coordIndex, faces->colorIndex, false);
    return std::move(reader.out);
  }
  if (is(SoVRMLElevationGrid::getClassTypeId())) {
    reader.read_heights(static_cast<SoVRMLElevationGrid*>(shape));
    return std::move(reader.out);
  }
  const bool strips =
      is(SoIndexedTriangleStripSet::getClassTypeId()) || is(SoTriangleStripSet::getClassTypeId());
  if (is(SoIndexedFaceSet::getClassTypeId()) || is(SoIndexedTriangleStripSet::getClassTypeId())) {
    auto* faces = static_cast<SoIndexedShape*>(shape);
    reader.take_points(action, faces);
    reader.read_indexed(faces->coordIndex, faces->materialIndex, strips);
  } else if (is(SoFaceSet::getClassTypeId())) {
    auto* faces = static_cast<SoFaceSet*>(shape);
    reader.take_points(action, faces);
    reader.read_listed(faces->numVertices, faces->startIndex.getValue(), false);
  } else if (is(SoTriangleStripSet::getClassTypeId())) {
    auto* faces = static_cast<SoTriangleStripSet*>(shape);
    reader.take_points(action, faces);
    reader.read_listed(faces->numVertices, faces->startIndex.getValue(), true);
  } else if (is(SoQuadMesh::getClassTypeId())) {
    auto* mesh = static_cast<SoQuadMesh*>(shape);
    reader.take_points(action, mesh);
    reader.read_grid(mesh->verticesPerColumn.getValue(), mesh->verticesPerRow.getValue(),
                     mesh->startIndex.getValue());
  } else {
    return {};
  }
  return std::move(reader.out);
}

}  // namespace clench
