// What was done to the triangles of a file before they became a body's surface.
#pragma once
#include <string>
#include <vector>

#include "clench/geometry/tree/shape.h"

namespace clench {

/// Who says how long a file's unit is.
enum class UnitSource { format, file, option, guess };

struct MeshReport {
  std::string format;         ///< "OBJ", "binary STL"
  int triangles_read = 0;     ///< faces of more corners are cut into triangles
  int vertices_read = 0;      ///< those that triangles use; three a triangle where none are shared
  int unused_vertices = 0;    ///< left out
  int welded_vertices = 0;    ///< became one with an earlier one
  int dropped_triangles = 0;  ///< without area, and of no use to close the surface
  bool flipped = false;       ///< was it inside out?
  double unit = 1;            ///< length of the file's unit [m]
  UnitSource unit_source = UnitSource::format;
  char up = 'z';  ///< the axis of the file that became z
};

/// "mm", "inch": where the length has a name; else "0.5 m".
std::string unit_name(double length);

/// "format", "file", "option", "guess"
const char* source_name(UnitSource source);

/// Lines for a reader: what was read, its unit, what was repaired; and of the shape that came of it
/// whether it is watertight, its size and faults, volume, centre of mass and inertia.
std::vector<std::string> describe(const MeshReport& report, const Shape& shape);

}  // namespace clench
