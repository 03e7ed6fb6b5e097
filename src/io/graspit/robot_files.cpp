#include "clench/io/graspit/robot_files.h"

#include "clench/base/text.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/spec/check_robot.h"

namespace clench {

namespace fs = std::filesystem;

// what a reader makes of the file that the robot's own, `referrer`, names; nothing when it is missing
template <class Value>
static std::optional<Value> read_named(Value (*read)(const fs::path&, const ReadOptions&),
                                       const RobotSpec& robot, const NamedFile& named,
                                       const fs::path& referrer, const ReadOptions& options,
                                       std::string& file) {
  if (named.name.empty()) return {};
  fs::path path;
  try {
    path = find_file(named.name, referrer, options);
  } catch (const Error& error) {
    if (options.warn) options.warn(fmt::format("{}: {}", named.place, error.what()));
    return {};
  }
  try {
    Value value = read(path, options);
    check_fit(robot, value);
    file = path.generic_string();
    return value;
  } catch (const Error& error) {
    fail(error.kind(), "{}: {}", named.place, error.what());
  }
}

// what the user chose must be there
template <class Value>
static void read_chosen(Value (*read)(const fs::path&, const ReadOptions&), const std::string& name,
                        const ReadOptions& options, const RobotSpec& robot,
                        std::optional<Value>& target, std::string& file) {
  if (name.empty()) return;
  const fs::path path = find_file(name, {}, options);
  Value value = read(path, options);
  try {
    check_fit(robot, value);
  } catch (const Error& error) {
    fail(error.kind(), "{}: {}", path.filename().string(), error.what());
  }
  target = std::move(value);
  file = path.generic_string();
}

static void note_other_robot(const RobotSpec& robot, const ReadOptions& options) {
  if (!options.note || !robot.virtual_contacts) return;
  const std::string& other = robot.virtual_contacts->robot;
  if (other != robot.name)
    options.note(fmt::format("{}: virtual contacts made for '{}' are used for '{}'",
                             fs::path(robot.files.virtual_contacts).filename().string(),
                             excerpt(other), excerpt(robot.name)));
}

void read_robot_files(RobotSpec& robot, const NamedFiles& names, const fs::path& path,
                      const ReadOptions& options) {
  if (options.eigengrasps.empty())
    robot.eigengrasps = read_named(read_eigengrasps, robot, names.eigengrasps, path, options,
                                   robot.files.eigengrasps);
  if (options.virtual_contacts.empty())
    robot.virtual_contacts = read_named(read_virtual_contacts, robot, names.virtual_contacts, path,
                                        options, robot.files.virtual_contacts);
  robot.glove = read_named(read_glove_calibration, robot, names.glove_calibration, path, options,
                           robot.files.glove_calibration);
  note_other_robot(robot, options);
}

void read_chosen_files(RobotSpec& robot, const ReadOptions& options) {
  read_chosen(read_eigengrasps, options.eigengrasps, options, robot, robot.eigengrasps,
              robot.files.eigengrasps);
  read_chosen(read_virtual_contacts, options.virtual_contacts, options, robot,
              robot.virtual_contacts, robot.files.virtual_contacts);
  if (!options.virtual_contacts.empty()) note_other_robot(robot, options);
}

}  // namespace clench
