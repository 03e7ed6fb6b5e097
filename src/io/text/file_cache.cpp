#include "clench/io/text/file_cache.h"

#include "clench/io/text/file_errors.h"
#include "clench/io/text/find_model.h"

namespace clench {

namespace fs = std::filesystem;

const BodySpec& FileCache::body(const fs::path& path) {
  options_.progress.tell(-1, path.filename().string());
  auto found = bodies_.find(path);
  if (found == bodies_.end()) found = bodies_.emplace(path, loaders_.body(path, *this)).first;
  return found->second;
}

const RobotSpec& FileCache::robot(const fs::path& path, const std::string& body) {
  options_.progress.tell(-1, path.filename().string());
  const std::pair key(path, body);
  auto found = robots_.find(key);
  if (found == robots_.end()) found = robots_.emplace(key, loaders_.robot(path, body, *this)).first;
  return found->second;
}

BodySpec FileCache::named_body(const std::string& name, const fs::path& referrer,
                               const Place& place) {
  BodySpec out = errors_at(
      place, [&] { return body(find_model(name, referrer, ModelKind::body, place, options_)); });
  out.source = name;
  return out;
}

RobotSpec FileCache::named_robot(const std::string& name, const fs::path& referrer,
                                 const Place& place) {
  const size_t at = name.rfind('#');
  const bool part = at != std::string::npos && at > 0;
  const std::string file = part ? name.substr(0, at) : name;
  RobotSpec out = errors_at(place, [&] {
    return robot(find_model(file, referrer, ModelKind::robot, place, options_),
                 part ? name.substr(at + 1) : "");
  });
  out.source = name;
  return out;
}

fs::path FileCache::find_part(const std::string& name, const fs::path& robot,
                              const Place& place) const {
  // in the folder iv/ next to the robot's file, or of the folder given by the caller
  std::vector<fs::path> folders = {robot.parent_path() / "iv"};
  if (!options_.folder.empty()) folders.push_back(options_.folder / "iv");
  for (const auto& folder : folders)
    if (const auto found = find_if_any(name, folder / "x", options_.beside_only())) return *found;
  if (const auto found = find_if_any(name, robot, options_)) return *found;
  return find_converted(name, folders.back() / "x", ModelKind::body, place, options_.beside_only());
}

BodySpec FileCache::part(const std::string& name, const fs::path& robot, const Place& place) {
  return errors_at(place, [&] {
    const fs::path found = find_part(name, robot, place);
    BodySpec out = body(found);
    out.source = found.generic_string();
    return out;
  });
}

}  // namespace clench
