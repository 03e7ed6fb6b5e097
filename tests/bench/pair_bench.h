// Collision, distance and near pairs of two meshes, ours and the others', in every situation.
#pragma once
#include "bench/pose_sets.h"
#include "bench/report.h"

namespace clench::bench {

void measure_pair(const MeshPair& pair, int poses, Report& report);

}  // namespace clench::bench
