// Random MJCF models of elements that both MuJoCo 2.2.2 and Clench read.
#pragma once
#include <cstdint>
#include <string>

namespace clench::test {

/// A valid model: trees of bodies with joints of all types, geoms of all solid types, meshes,
/// inertials, classes and compiler settings, in all spellings of orientations. The same seed gives
/// the same text.
std::string random_mjcf(uint64_t seed);

}  // namespace clench::test
