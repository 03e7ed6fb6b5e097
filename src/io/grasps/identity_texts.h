// Texts with which a grasp in a file identifies its hand, its object and the settings of its
// measurement.
#pragma once
#include <string>
#include <utility>

#include "clench/spec/grasp_spec.h"

namespace clench {

/// Names in JSON lines and columns of tables; the names of .npz arrays have an s appended.
inline constexpr std::pair<const char*, std::string GraspSpec::*> identity_texts[] = {
    {"hand_fingerprint", &GraspSpec::hand_fingerprint},
    {"object_fingerprint", &GraspSpec::object_fingerprint},
    {"settings_fingerprint", &GraspSpec::settings_fingerprint},
    {"engine_version", &GraspSpec::engine_version}};

}  // namespace clench
