#include "io/inventor_shapes.h"

#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoFaceSet.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoIndexedTriangleStripSet.h>
#include <Inventor/nodes/SoQuadMesh.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTriangleStripSet.h>
#include <Inventor/nodes/SoVertexProperty.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <fmt/format.h>

#include <cmath>

namespace clench {

namespace {

// ear clipping grows with the square of a polygon's corners
constexpr int most_corners = 4000;

std::string type_name(const SoNode* node) {
  const std::string name = node->getTypeId().getName().getString();
  return name.starts_with("VRML") ? name.substr(4) : name;
}

/// Polygons or strips of an indexed shape: indices within the coordinates, polygons not too large.
std::string check_indices(const SoMFInt32& indices, int coordinates, bool polygons, int& faces) {
  int corners = 0;
  faces = 0;
  for (int i = 0; i < indices.getNum(); ++i) {
    const int index = indices[i];
    if (index == -1) {
      ++faces;
      corners = 0;
      continue;
    }
    if (index < 0 || index >= coordinates)
      return fmt::format("number {} of coordIndex: wanted -1 or a number of one of {} points, got {}", i, coordinates, index);
    if (++corners > most_corners && polygons)
      return fmt::format("face {}: wanted at most {} corners", faces, most_corners);
  }
  if (corners > 0) ++faces;
  return "";
}

/// Lists of strips or faces of a non-indexed shape.
std::string check_counts(const SoMFInt32& counts, int start, int coordinates, bool polygons) {
  long long used = start;
  if (start < 0) return fmt::format("startIndex: wanted a number from 0, got {}", start);
  for (int i = 0; i < counts.getNum(); ++i) {
    const int count = counts[i] == -1 ? static_cast<int>(std::max(0LL, coordinates - used)) : counts[i];
    if (count < 3 && counts[i] != -1)
      return fmt::format("number {} of numVertices: wanted at least 3, got {}", i, counts[i]);
    if (count > most_corners && polygons)
      return fmt::format("face {}: wanted at most {} corners, got {}", i, most_corners, count);
    used += count;
    if (used > coordinates)
      return fmt::format("number {} of numVertices: wanted at most {} points in all, got {}", i, coordinates, used);
  }
  return "";
}

/// Number of points a shape of the Inventor kind draws from; strips its properties of normals and textures.
int inventor_points(SoCallbackAction* action, SoVertexShape* shape, std::string& error) {
  SoNode* property = shape->vertexProperty.getValue();
  if (!property) return action->getNumCoordinates();
  if (!property->isOfType(SoVertexProperty::getClassTypeId())) {
    error = fmt::format("vertexProperty: wanted a VertexProperty, got a {}", type_name(property));
    return 0;
  }
  auto* points = static_cast<SoVertexProperty*>(property);
  points->enableNotify(FALSE);
  points->normal.setNum(0);
  points->texCoord.setNum(0);
  points->texCoord3.setNum(0);
  return points->vertex.getNum() > 0 ? points->vertex.getNum() : action->getNumCoordinates();
}

void drop_unfit_material_indices(SoCallbackAction* action, SoIndexedShape* shape, int faces) {
  SoMFInt32& indices = shape->materialIndex;
  if (indices.getNum() == 0 || (indices.getNum() == 1 && indices[0] == -1)) return;
  int binding = action->getMaterialBinding();
  if (SoNode* p = shape->vertexProperty.getValue())
    binding = static_cast<SoVertexProperty*>(p)->materialBinding.getValue();
  const bool by_vertex = binding == SoMaterialBinding::PER_VERTEX_INDEXED || binding == SoMaterialBinding::PER_VERTEX;
  if (indices.getNum() < (by_vertex ? shape->coordIndex.getNum() : faces)) indices.setValue(-1);
}

std::string check_indexed(SoCallbackAction* action, SoIndexedShape* shape, bool polygons) {
  std::string error;
  const int points = inventor_points(action, shape, error);
  if (!error.empty()) return error;
  int faces = 0;
  error = check_indices(shape->coordIndex, points, polygons, faces);
  shape->normalIndex.setValue(-1);
  shape->textureCoordIndex.setValue(-1);
  drop_unfit_material_indices(action, shape, faces);
  return error;
}

template <class Set>
std::string check_listed(SoCallbackAction* action, Set* shape, bool polygons) {
  std::string error;
  const int points = inventor_points(action, shape, error);
  return error.empty() ? check_counts(shape->numVertices, shape->startIndex.getValue(), points, polygons) : error;
}

std::string check_quads(SoCallbackAction* action, SoQuadMesh* shape) {
  std::string error;
  const int points = inventor_points(action, shape, error);
  if (!error.empty()) return error;
  const long long rows = shape->verticesPerColumn.getValue(), columns = shape->verticesPerRow.getValue();
  const long long start = shape->startIndex.getValue();
  if (rows < 2 || columns < 2 || start < 0 || start + rows * columns > points)
    return fmt::format("wanted at least 2 x 2 of {} points, got {} x {} from {}", points, columns, rows, start);
  return "";
}

std::string check_vrml_faces(SoVRMLIndexedFaceSet* shape) {
  SoNode* coord = shape->coord.getValue();
  if (coord && !coord->isOfType(SoVRMLCoordinate::getClassTypeId()))
    return fmt::format("coord: wanted a Coordinate, got a {}", type_name(coord));
  const int points = coord ? static_cast<SoVRMLCoordinate*>(coord)->point.getNum() : 0;
  int faces = 0;
  const std::string error = check_indices(shape->coordIndex, points, true, faces);
  shape->normal.setValue(nullptr);
  shape->texCoord.setValue(nullptr);
  shape->normalIndex.setNum(0);
  shape->texCoordIndex.setNum(0);

  // colours that are too few are none
  SoNode* color = shape->color.getValue();
  const bool by_vertex = shape->colorPerVertex.getValue();
  const int colors = color && color->isOfType(SoVRMLColor::getClassTypeId())
                         ? static_cast<SoVRMLColor*>(color)->color.getNum() : 0;
  const int listed = shape->colorIndex.getNum();
  const int wanted = by_vertex ? (listed ? shape->coordIndex.getNum() : points) : faces;
  bool fits = colors > 0 && (listed ? listed : colors) >= wanted;
  for (int i = 0; fits && i < listed; ++i) fits = shape->colorIndex[i] < colors;
  if (!fits) {
    shape->color.setValue(nullptr);
    shape->colorIndex.setNum(0);
  }
  return error;
}

std::string check_grid(SoVRMLElevationGrid* shape) {
  const long long x = shape->xDimension.getValue(), z = shape->zDimension.getValue();
  if (x < 0 || z < 0 || x * z > shape->height.getNum())
    return fmt::format("wanted {} x {} heights, got {}", x, z, shape->height.getNum());
  shape->normal.setValue(nullptr);
  shape->texCoord.setValue(nullptr);
  shape->color.setValue(nullptr);
  return "";
}

/// Sizes of the round and square shapes: finite, not negative.
std::string check_sizes(std::initializer_list<std::pair<const char*, const SoSFFloat*>> sizes) {
  for (const auto& [name, field] : sizes) {
    const float value = field->getValue();
    if (!std::isfinite(value) || value < 0) return fmt::format("{}: wanted a size >= 0, got {}", name, value);
  }
  return "";
}

/// Number of arms that ask for a size of a primitive, or "" when the shape is none of them.
bool check_primitive(SoNode* node, std::string& error) {
  const auto is = [&](SoType type) { return node->isOfType(type); };
  if (is(SoCube::getClassTypeId())) {
    auto* s = static_cast<SoCube*>(node);
    error = check_sizes({{"width", &s->width}, {"height", &s->height}, {"depth", &s->depth}});
  } else if (is(SoSphere::getClassTypeId())) {
    error = check_sizes({{"radius", &static_cast<SoSphere*>(node)->radius}});
  } else if (is(SoCylinder::getClassTypeId())) {
    auto* s = static_cast<SoCylinder*>(node);
    error = check_sizes({{"radius", &s->radius}, {"height", &s->height}});
  } else if (is(SoCone::getClassTypeId())) {
    auto* s = static_cast<SoCone*>(node);
    error = check_sizes({{"bottomRadius", &s->bottomRadius}, {"height", &s->height}});
  } else {
    return is(SoVRMLBox::getClassTypeId()) || is(SoVRMLSphere::getClassTypeId()) ||
           is(SoVRMLCylinder::getClassTypeId()) || is(SoVRMLCone::getClassTypeId());
  }
  return true;
}

}  // namespace

ShapeVerdict check_shape(SoCallbackAction* action, SoNode* node) {
  node->enableNotify(FALSE);   // a change is nobody's business, and telling costs
  ShapeVerdict verdict{true, "", ""};
  const auto is = [&](SoType type) { return node->isOfType(type); };
  if (check_primitive(node, verdict.error)) {
  } else if (is(SoIndexedFaceSet::getClassTypeId())) {
    verdict.error = check_indexed(action, static_cast<SoIndexedShape*>(node), true);
  } else if (is(SoIndexedTriangleStripSet::getClassTypeId())) {
    verdict.error = check_indexed(action, static_cast<SoIndexedShape*>(node), false);
  } else if (is(SoFaceSet::getClassTypeId())) {
    verdict.error = check_listed(action, static_cast<SoFaceSet*>(node), true);
  } else if (is(SoTriangleStripSet::getClassTypeId())) {
    verdict.error = check_listed(action, static_cast<SoTriangleStripSet*>(node), false);
  } else if (is(SoQuadMesh::getClassTypeId())) {
    verdict.error = check_quads(action, static_cast<SoQuadMesh*>(node));
  } else if (is(SoVRMLIndexedFaceSet::getClassTypeId())) {
    verdict.error = check_vrml_faces(static_cast<SoVRMLIndexedFaceSet*>(node));
  } else if (is(SoVRMLElevationGrid::getClassTypeId())) {
    verdict.error = check_grid(static_cast<SoVRMLElevationGrid*>(node));
  } else {
    verdict.use = is(SoVRMLExtrusion::getClassTypeId());
    const bool silent = type_name(node).find("Line") != std::string::npos || type_name(node).find("Point") != std::string::npos ||
                        type_name(node).find("Text") != std::string::npos;
    if (!verdict.use && !silent) verdict.warning = fmt::format("{} is not used as geometry", type_name(node));
  }
  if (!verdict.error.empty()) verdict.error = type_name(node) + ": " + verdict.error;
  return verdict;
}

}  // namespace clench
