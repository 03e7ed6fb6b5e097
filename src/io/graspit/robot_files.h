// The files that a robot's file names: eigengrasps, virtual contacts, calibration of a glove.
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// A name as a robot's file holds it, and where: "Barrett.cfg:83".
struct NamedFile {
  std::string name;  ///< empty: none
  Place place;
};

struct NamedFiles {
  NamedFile eigengrasps, virtual_contacts, glove_calibration;
};

/// Reads them into the robot, whose DOFs and links are known by now; `path` is its own file.
/// Those that the options choose are left out. A named file that does not exist is a warning.
/// throws Error  "Barrett.cfg:83: EigenGrasps: a.egr:5: ..." when one is malformed or does not fit
void read_robot_files(RobotSpec& robot, const NamedFiles& names, const std::filesystem::path& path,
                      const ReadOptions& options);

/// Reads those that the options choose, for a robot of any format.
/// throws Error when one does not exist, is malformed or does not fit
void read_chosen_files(RobotSpec& robot, const ReadOptions& options);

}  // namespace clench
