// Files already read in one call: a link that five fingers share is read, and kept, once.
#pragma once
#include <map>

#include "io/read.h"

namespace clench {

/// Bodies and robots by the file they stand in. Lives as long as one call of read_robot or
/// read_world.
class Library {
 public:
  explicit Library(const ReadOptions& options) : options_(options) {}

  const ReadOptions& options() const { return options_; }
  void warn(const std::string& sentence) const {
    if (options_.warn) options_.warn(sentence);
  }
  void note(const std::string& sentence) const {
    if (options_.note) options_.note(sentence);
  }
  /// `path` as find_file gives it
  const BodySpec& body(const std::filesystem::path& path);
  const RobotSpec& robot(const std::filesystem::path& path);

 private:
  const ReadOptions& options_;
  std::map<std::filesystem::path, BodySpec> bodies_;
  std::map<std::filesystem::path, RobotSpec> robots_;
};

}  // namespace clench
