// Report on the conversion of a file's triangles to a body's surface.
#pragma once
#include <string>
#include <vector>

#include "clench/geometry/tree/shape.h"

namespace clench {

/// Source of a file's unit of length.
enum class UnitSource { format, file, option, guess };

struct MeshReport {
  std::string format;         ///< "OBJ", "binary STL"
  int triangles_read = 0;     ///< faces of more corners are cut into triangles
  int vertices_read = 0;      ///< vertices used by triangles; three per triangle if none are shared
  int unused_vertices = 0;    ///< omitted
  int welded_vertices = 0;    ///< merged with an earlier one
  int dropped_triangles = 0;  ///< degenerate, and not needed to close the surface
  bool flipped = false;       ///< was it inside out?
  double unit = 1;            ///< length of the file's unit [m]
  UnitSource unit_source = UnitSource::format;
  char up = 'z';  ///< the axis of the file that was mapped to z
};

/// "mm", "inch", if the unit has a name; otherwise "0.5 m".
std::string unit_name(double length);

/// "format", "file", "option", "guess"
const char* source_name(UnitSource source);

/// Lines of text: what was read, its unit, what was repaired; and for the resulting shape whether
/// it is watertight, its size and defects, volume, center of mass and inertia.
std::vector<std::string> describe(const MeshReport& report, const Shape& shape);

}  // namespace clench
