#include "io/robot_files.h"

#include "base/error.h"
#include "io/eigengrasps.h"
#include "io/glove_files.h"
#include "io/virtual_contacts.h"

namespace clench {

namespace fs = std::filesystem;

// what a reader makes of the file, or nothing; says which file it was
template <class Value>
static std::optional<Value> read_named(Value (*read)(const fs::path&, const ReadOptions&),
                                       const RobotSpec& robot, const NamedFile& named,
                                       const fs::path& referrer, const ReadOptions& options,
                                       std::string& file) {
  const std::string subject = named.place.empty() ? "" : named.place + ": ";
  file.clear();
  if (named.name.empty()) return {};
  fs::path path;
  try {
    path = find_file(named.name, referrer, options);
  } catch (const Error& error) {
    // the user's own choice must exist
    if (referrer.empty()) throw;
    if (options.warn) options.warn(subject + error.what());
    return {};
  }
  try {
    Value value = read(path, options);
    check_fit(robot, value);
    file = path.generic_string();
    return value;
  } catch (const Error& error) {
    fail("{}{}", subject, error.what());
  }
}

void read_robot_files(RobotSpec& robot, const NamedFiles& names, const fs::path& path,
                      const ReadOptions& options) {
  const auto read = [&](auto reader, const std::string& own, const NamedFile& named,
                        std::string& file) {
    if (!own.empty()) return read_named(reader, robot, {own, ""}, {}, options, file);
    return read_named(reader, robot, named, path, options, file);
  };
  robot.eigengrasps =
      read(read_eigengrasps, options.eigengrasps, names.eigengrasps, robot.files.eigengrasps);
  robot.virtual_contacts = read(read_virtual_contacts, options.virtual_contacts,
                                names.virtual_contacts, robot.files.virtual_contacts);
  robot.glove =
      read(read_glove_calibration, "", names.glove_calibration, robot.files.glove_calibration);
  if (options.note && robot.virtual_contacts && robot.virtual_contacts->robot != robot.name)
    options.note(fmt::format("{}: virtual contacts made for '{}' are used for '{}'",
                             robot.files.virtual_contacts, robot.virtual_contacts->robot,
                             robot.name));
}

}  // namespace clench
