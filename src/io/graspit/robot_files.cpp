#include "clench/io/graspit/robot_files.h"

#include "clench/base/text.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/text/file_errors.h"
#include "clench/spec/check_robot.h"

namespace clench {

namespace fs = std::filesystem;

template <class Value>
static Value fitted(const RobotSpec& robot, Value value, const fs::path&, const ReadOptions&) {
  check_fit(robot, value);
  return value;
}

static std::vector<VirtualContactSpec> fitted(const RobotSpec& robot, VirtualContactSet set,
                                              const fs::path& path, const ReadOptions& options) {
  if (set.robot != robot.name)
    options.diagnostics.note(Place(path.filename().string()),
                             "virtual contacts made for '{}' are used for '{}'", excerpt(set.robot),
                             excerpt(robot.name));
  return contacts_on(robot, std::move(set));
}

// Reads the file named in the robot's own file `referrer`, if any.
template <class Value, class Held>
static void read_named(Value (*read)(const fs::path&, const ReadOptions&), const RobotSpec& robot,
                       const NamedFile& named, const fs::path& referrer, const ReadOptions& options,
                       std::optional<Held>& target, std::string& file) {
  if (named.name.empty()) return;
  fs::path path;
  try {
    path = find_file(named.name, referrer, options);
  } catch (const Error& error) {
    options.diagnostics.warn(named.place, "{}", error.what());
    return;
  }
  target =
      errors_at(named.place, [&] { return fitted(robot, read(path, options), path, options); });
  file = path.generic_string();
}

// files named by the user must exist
template <class Value, class Held>
static void read_chosen(Value (*read)(const fs::path&, const ReadOptions&), const std::string& name,
                        const ReadOptions& options, const RobotSpec& robot,
                        std::optional<Held>& target, std::string& file) {
  if (name.empty()) return;
  const fs::path path = find_file(name, {}, options);
  Value value = read(path, options);
  target = errors_at(Place(path.filename().string()),
                     [&] { return fitted(robot, std::move(value), path, options); });
  file = path.generic_string();
}

void read_robot_files(RobotSpec& robot, const NamedFiles& names, const fs::path& path,
                      const ReadOptions& options) {
  if (options.eigengrasps.empty())
    read_named(read_eigengrasps, robot, names.eigengrasps, path, options, robot.eigengrasps,
               robot.files.eigengrasps);
  if (options.virtual_contacts.empty())
    read_named(read_virtual_contacts, robot, names.virtual_contacts, path, options,
               robot.virtual_contacts, robot.files.virtual_contacts);
  read_named(read_glove_calibration, robot, names.glove_calibration, path, options, robot.glove,
             robot.files.glove_calibration);
}

void read_chosen_files(RobotSpec& robot, const ReadOptions& options) {
  read_chosen(read_eigengrasps, options.eigengrasps, options, robot, robot.eigengrasps,
              robot.files.eigengrasps);
  read_chosen(read_virtual_contacts, options.virtual_contacts, options, robot,
              robot.virtual_contacts, robot.files.virtual_contacts);
}

}  // namespace clench
