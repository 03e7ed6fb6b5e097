#include "clench/io/read/tree_files.h"

#include "clench/base/text.h"
#include "clench/io/mjcf/mjcf.h"
#include "clench/io/text/xml.h"
#include "clench/io/urdf/urdf.h"

namespace clench {

namespace fs = std::filesystem;

bool is_robot_tree(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".urdf" || extension == ".mjcf" || extension == ".xacro") return true;
  if (extension != ".xml") return false;
  const std::string text = read_text(path);
  return xml_root_name(text) == "mujoco" || looks_like_urdf(text);
}

bool is_scene(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  return (extension == ".xml" || extension == ".mjcf" || extension == ".urdf") &&
         xml_root_name(read_text(path)) == "mujoco";
}

RobotSpec read_robot_tree(const fs::path& path, const std::string& body, FileCache& cache) {
  const std::string file = path.filename().string();
  if (lower_case(path.extension().string()) == ".xacro")
    fail("{}: a xacro file must be expanded first: xacro {} > robot.urdf", file, file);
  const std::string text = read_text(path);
  if (!body.empty()) return read_robot_mjcf(path, body, cache);
  if (xml_root_name(text) == "mujoco") return read_robot_mjcf(path, cache);
  return read_robot_urdf(path, cache);
}

}  // namespace clench
