// Pairs of meshes, and poses in which they are far, near, touching and penetrating: the same on
// every machine.
#pragma once
#include <string>
#include <vector>

#include "clench/geometry/query/queries.h"

namespace clench::bench {

struct MeshPair {
  std::string name;
  ShapePtr a, b;
};

/// Links and objects of the shipped models, and of ../shared/data if present.
std::vector<MeshPair> mesh_pairs();

struct Situation {
  const char* name;
  double low, high;  ///< gap, negative for a depth [m]
};
inline constexpr Situation situations[] = {{"far", 20e-3, 120e-3},
                                           {"near", 1e-3, 10e-3},
                                           {"touching", 5e-6, 95e-6},
                                           {"penetrating", -8.5e-3, -0.5e-3}};

/// b in random orientations, moved along the line between the nearest points to a gap drawn from
/// the range of the situation.
std::vector<Pose> poses_of(const MeshPair& pair, const Situation& situation, int count,
                           uint64_t seed);

}  // namespace clench::bench
