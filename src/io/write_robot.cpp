#include "io/write_robot.h"

#include "base/file.h"
#include "base/text.h"
#include "io/dh_robot.h"
#include "io/write_robot_texts.h"

namespace clench {

namespace fs = std::filesystem;

/// Products of numbers that are in order may not be.
static void check_writable(const RobotSpec& robot, const std::string& file) {
  try {
    check_robot(robot);
  } catch (const Error& error) {
    fail("{} cannot be written: {}", file, error.what());
  }
}

void write_robot(const RobotSpec& robot, const fs::path& path, const WriteOptions& options) {
  const std::string ending = lower_case(path.extension().string());
  const std::string file = path.filename().string();
  if (ending != ".cfg" && ending != ".xml" && ending != ".urdf")
    fail("{}: wanted a robot to .cfg, .xml or .urdf, got {}", file, in_quotes(ending));
  check_folder_of(path);
  std::error_code code;
  if (fs::is_directory(path, code))
    fail("{}: wanted a file to write, got a folder", path.generic_string());
  check_writable(robot, file);
  RobotFolder folder(path, options);
  if (ending == ".urdf") {
    const std::string text = robot_urdf_text(robot, folder);
    tell_lost_in_urdf(robot, folder);
    return folder.write(text);
  }
  const RobotSpec plain = dh_robot(robot, file, options.warn);
  check_writable(plain, file);
  const std::string text =
      ending == ".cfg" ? robot_cfg_text(plain, folder) : robot_xml_text(plain, folder);
  tell_lost_in_both(plain, folder);
  (ending == ".cfg" ? tell_lost_in_cfg : tell_lost_in_xml)(plain, folder);
  folder.write(text);
}

}  // namespace clench
