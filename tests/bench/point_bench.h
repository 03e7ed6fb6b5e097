// Points and rays against a mesh, and the cost of preparing a mesh.
#pragma once
#include <string>

#include "bench/report.h"
#include "clench/geometry/tree/shape.h"

namespace clench::bench {

void measure_points(const std::string& name, const Shape& shape, int count, Report& report);
void measure_building(const std::string& name, const Shape& shape, Report& report);
/// reading and preparing a sphere of about this many triangles [s]
void measure_large_mesh(int triangles, Report& report);

}  // namespace clench::bench
