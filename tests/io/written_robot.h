// A robot written and read again, with all diagnostics.
#pragma once
#include <algorithm>

#include "clench/io/read/read.h"
#include "clench/io/write/write_robot.h"
#include "support/listening.h"

namespace clench::test {

struct WrittenRobot {
  RobotSpec robot;  ///< read again
  std::vector<std::string> lost;
  std::vector<std::string> warnings;  ///< of reading it
  bool told(const std::string& sentence) const { return std::ranges::count(lost, sentence) > 0; }
};

inline WrittenRobot written(const RobotSpec& robot, const std::filesystem::path& path) {
  WrittenRobot out;
  ReadOptions reading;
  reading.diagnostics =
      Listening{.warn = [&](const std::string& sentence) { out.warnings.push_back(sentence); }};
  WriteOptions options;
  options.diagnostics =
      Listening{.warn = [&](const std::string& sentence) { out.lost.push_back(sentence); }};
  write_robot(robot, path, options);
  out.robot = read_robot(path, reading);
  return out;
}

}  // namespace clench::test
