// The files that a robot's file names: eigengrasps, virtual contacts, calibration of a glove.
#pragma once
#include <filesystem>

#include "io/read.h"

namespace clench {

/// A name as a robot's file holds it, and where: "Barrett.cfg:83".
struct NamedFile {
  std::string name;  ///< empty: none
  std::string place;
};

struct NamedFiles {
  NamedFile eigengrasps, virtual_contacts, glove_calibration;
};

/// Reads them into the robot, whose DOFs, chains and links are known by now; `path` is its own file.
/// The options' own eigengrasps and virtual contacts replace those of the
/// file. A named file that does not exist is a warning.
/// throws Error  "Barrett.cfg:83: a.egr:5: ..." when one is malformed or does not fit the robot
void read_robot_files(RobotSpec& robot, const NamedFiles& names, const std::filesystem::path& path,
                      const ReadOptions& options);

}  // namespace clench
