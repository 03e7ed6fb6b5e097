// Files of data gloves: calibrations, and the poses used to compute them.
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/glove_spec.h"

namespace clench {

/// Text: `DOFs sensors`, a row of slopes for each DOF, then the intercepts [rad].
/// throws Error  "glove.txt:3: DOF 1: slope 4: expected a number, got 'x'"
GloveCalibration read_glove_calibration(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

/// A posture recorded with the glove. Lists are empty if the file leaves them out.
struct GlovePose {
  std::optional<double> distance;  ///< between the fingertips that should touch [m]
  std::vector<int> sensors;        ///< raw readings
  std::vector<int> dof_of_sensor;  ///< from 0; -1: unused sensor
  std::vector<double> joints;      ///< [rad]
  Pose pose;                       ///< of the hand
};

std::vector<GlovePose> read_glove_poses(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

}  // namespace clench
