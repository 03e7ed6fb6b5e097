// Reads the files named in a robot's file: eigengrasps, virtual contacts, calibration of a glove.
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// A file name in a robot's file, and its place: "Barrett.cfg:83".
struct NamedFile {
  std::string name;  ///< empty: none
  Place place;
};

struct NamedFiles {
  NamedFile eigengrasps, virtual_contacts, glove_calibration;
};

/// Reads them into the robot, whose DOFs and links must be complete; `path` is its file. Kinds for
/// which the options name other files are skipped. A missing file is reported as a warning.
/// throws Error  "Barrett.cfg:83: EigenGrasps: a.egr:5: ..." if one is malformed or does not fit
/// the robot
void read_robot_files(RobotSpec& robot, const NamedFiles& names, const std::filesystem::path& path,
                      const ReadOptions& options);

/// Reads the files named by the options, for a robot of any format.
/// throws Error if one does not exist, is malformed or does not fit the robot
void read_chosen_files(RobotSpec& robot, const ReadOptions& options);

}  // namespace clench
