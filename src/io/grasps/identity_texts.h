// The texts by which a grasp in a file names what it was measured of, and with.
#pragma once
#include <string>
#include <utility>

#include "clench/spec/grasp_spec.h"

namespace clench {

/// Names in JSON lines and columns of tables; arrays of .npz have an s behind them.
inline constexpr std::pair<const char*, std::string GraspSpec::*> identity_texts[] = {
    {"hand_fingerprint", &GraspSpec::hand_fingerprint},
    {"object_fingerprint", &GraspSpec::object_fingerprint},
    {"settings_fingerprint", &GraspSpec::settings_fingerprint},
    {"engine_version", &GraspSpec::engine_version}};

}  // namespace clench
