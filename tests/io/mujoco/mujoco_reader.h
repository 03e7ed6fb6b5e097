// An MJCF file as read by MuJoCo.
#pragma once
#include <filesystem>

#include "model_facts.h"

namespace clench::test {

/// Facts of the compiled model with all joints at their references, except for joints coupled by an
/// equality, which are where it puts them. Bodies and joints without a name are called "#n", by
/// their number from 0, with the world as body #0.
ModelFacts read_by_mujoco(const std::filesystem::path& path);

}  // namespace clench::test
