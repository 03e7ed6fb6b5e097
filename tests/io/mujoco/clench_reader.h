// An MJCF file as Clench reads it, as a scene.
#pragma once
#include <filesystem>

#include "model_facts.h"

namespace clench::test {

/// Facts of the world that the file becomes. Names are as in read_by_mujoco; obstacles are not
/// weighed, and a free body stands for all that is fixed to it.
/// theirs    gives the references of the joints, at which the robots stand
/// warnings  appended to
ModelFacts read_by_clench(const std::filesystem::path& path, const ModelFacts& theirs,
                          std::vector<std::string>& warnings);

}  // namespace clench::test
