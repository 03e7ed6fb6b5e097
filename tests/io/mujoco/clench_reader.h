// An MJCF file as read by Clench as a scene.
#pragma once
#include <filesystem>

#include "model_facts.h"

namespace clench::test {

/// Facts of the world created from the file. Names are as in read_by_mujoco; masses of obstacles
/// are not compared, and a free body represents all bodies fixed to it.
/// theirs    provides the references of the joints, at which the robots are posed
/// warnings  appended to
ModelFacts read_by_clench(const std::filesystem::path& path, const ModelFacts& theirs,
                          std::vector<std::string>& warnings);

}  // namespace clench::test
