// Files already read in one call: a link that five fingers share is read, and kept, once.
#pragma once
#include <map>

#include "clench/io/text/read_options.h"
#include "clench/spec/robot_spec.h"

namespace clench {

class FileCache;

/// How a file that was found becomes a spec. What else it names is asked of the cache.
struct Loaders {
  BodySpec (*body)(const std::filesystem::path& path, FileCache& cache);
  /// body  of a scene: the body that the robot's tree of joints begins with; empty: the robot of
  ///       the file
  RobotSpec (*robot)(const std::filesystem::path& path, const std::string& body, FileCache& cache);
};

/// Bodies and robots by the file they stand in. Lives as long as one call of read_robot or
/// read_world.
class FileCache {
 public:
  FileCache(const ReadOptions& options, const Loaders& loaders)
      : options_(options), loaders_(loaders) {}

  const ReadOptions& options() const { return options_; }
  const Diagnostics& diagnostics() const { return options_.diagnostics; }
  /// `path` as find_model gives it
  const BodySpec& body(const std::filesystem::path& path);
  const RobotSpec& robot(const std::filesystem::path& path, const std::string& body = "");
  /// The body that a line of another file names; errors begin with `place`, dlr.wld:3.
  BodySpec named_body(const std::string& name, const std::filesystem::path& referrer,
                      const Place& place);
  /// "scene.xml#arm": that robot of a scene.
  RobotSpec named_robot(const std::string& name, const std::filesystem::path& referrer,
                        const Place& place);
  /// The body of a link: names in a robot's file `robot` count from the folder iv/ beside it,
  /// then as find_file has it.
  BodySpec part(const std::string& name, const std::filesystem::path& robot, const Place& place);

 private:
  std::filesystem::path find_part(const std::string& name, const std::filesystem::path& robot,
                                  const Place& place) const;

  const ReadOptions& options_;
  const Loaders& loaders_;
  std::map<std::filesystem::path, BodySpec> bodies_;
  std::map<std::pair<std::filesystem::path, std::string>, RobotSpec> robots_;
};

}  // namespace clench
