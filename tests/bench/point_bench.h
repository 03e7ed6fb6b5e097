// Points and rays against a mesh, and what it costs to make one ready.
#pragma once
#include <string>

#include "bench/report.h"
#include "clench/geometry/tree/shape.h"

namespace clench::bench {

void measure_points(const std::string& name, const Shape& shape, int count, Report& report);
void measure_building(const std::string& name, const Shape& shape, Report& report);
/// reading and preparing a sphere of about so many triangles [s]
void measure_large_mesh(int triangles, Report& report);

}  // namespace clench::bench
