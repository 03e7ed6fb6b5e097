// Caches the files read in one call: a link used by five fingers is read and stored once.
#pragma once
#include <map>

#include "clench/io/text/read_options.h"
#include "clench/spec/robot_spec.h"

namespace clench {

class FileCache;

/// Functions that read a file into a spec. They read all further files through the cache.
struct Loaders {
  BodySpec (*body)(const std::filesystem::path& path, FileCache& cache);
  /// body  scenes: the root body of the robot's joint tree; empty: the robot of the file
  RobotSpec (*robot)(const std::filesystem::path& path, const std::string& body, FileCache& cache);
};

/// Bodies and robots by file. Its lifetime is one call of read_robot or read_world.
class FileCache {
 public:
  FileCache(const ReadOptions& options, const Loaders& loaders)
      : options_(options), loaders_(loaders) {}

  const ReadOptions& options() const { return options_; }
  const Diagnostics& diagnostics() const { return options_.diagnostics; }
  /// `path` as returned by find_model
  const BodySpec& body(const std::filesystem::path& path);
  const RobotSpec& robot(const std::filesystem::path& path, const std::string& body = "");
  /// The body named on a line of another file; errors begin with `place`, dlr.wld:3.
  BodySpec named_body(const std::string& name, const std::filesystem::path& referrer,
                      const Place& place);
  /// A robot by file name; "scene.xml#arm" names a robot of a scene.
  RobotSpec named_robot(const std::string& name, const std::filesystem::path& referrer,
                        const Place& place);
  /// The body of a link: names in a robot's file `robot` are relative to the folder iv/ next to it,
  /// otherwise looked up as by find_file.
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
