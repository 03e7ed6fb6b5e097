// Where our own models and worlds lie.
#pragma once
#include <filesystem>

namespace clench {

/// The folder that holds models/ and worlds/: the environment's CLENCH_MODELS; else, seen from the
/// executable or the module that this code is in, ../share/clench or ../../../share/clench
/// (installed), or ../.. (a build tree). Empty when none of them is there.
std::filesystem::path home_folder();

}  // namespace clench
