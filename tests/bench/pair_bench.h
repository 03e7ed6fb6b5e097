// Collision, distance and close pairs of two meshes, in Clench and other libraries, in every
// situation.
#pragma once
#include "bench/pose_sets.h"
#include "bench/report.h"

namespace clench::bench {

void measure_pair(const MeshPair& pair, int poses, Report& report);

}  // namespace clench::bench
