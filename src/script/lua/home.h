// Location of the models and worlds of Clench.
#pragma once
#include <filesystem>

namespace clench {

/// The folder that contains models/ and worlds/: the environment's CLENCH_MODELS; otherwise,
/// relative to the executable or the module that contains this code, ../share/clench or
/// ../../../share/clench (installed), or ../.. (a build tree). Empty if none of them exists.
std::filesystem::path home_folder();

}  // namespace clench
