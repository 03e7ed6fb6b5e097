// An MJCF file as MuJoCo reads it.
#pragma once
#include <filesystem>

#include "model_facts.h"

namespace clench::test {

/// Facts of the compiled model with all joints at their references, but for joints that an equality
/// couples, which stand where it puts them. Bodies and joints without a name are called "#n",
/// by their number from 0, the world being body #0.
ModelFacts read_by_mujoco(const std::filesystem::path& path);

}  // namespace clench::test
