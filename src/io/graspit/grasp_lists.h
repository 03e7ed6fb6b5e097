// Lists of grasps of GraspIt!'s primitive planner: text files with one grasp per line.
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/io/text/grasp_sink.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Start pose and shape of a hand, in the object's frame.
struct Pregrasp {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< of the palm [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< approach direction, unit
  Eigen::Vector3d thumb = Eigen::Vector3d::UnitX();      ///< direction of the thumb, unit
  double spread = 0;                                     ///< of the fingers [rad]
};

/// Lines of `[point][direction][thumb]spread`, in millimeters and degrees.
/// throws Error  "list.txt:3: expected [x y z][x y z][x y z] and a spread angle, got '...'"
std::vector<Pregrasp> read_pregrasps(const std::filesystem::path& path,
                                     const ReadOptions& options = {});
void write_pregrasps(const std::vector<Pregrasp>& pregrasps, const std::filesystem::path& path);

/// Grasps with only a pose, the measure "quality" (<= 0: no grasp), and the notes "run", from 1,
/// because a file may collect several runs, and "spread" [rad]. Lines of `x y z qw qx qy qz spread
/// quality`, in millimeters and degrees; a line of zeros that ends in -2 begins a run.
std::vector<GraspSpec> read_planned_grasps(const std::filesystem::path& path,
                                           const ReadOptions& options = {});
/// The same from a text; `file` is the name shown in errors.
void read_planned_grasps(const std::string& file, std::string text, const GraspSink& sink,
                         const ReadOptions& options);
/// throws Error if a grasp has no pose, or the runs are not in ascending order
std::string planned_grasps_text(const std::vector<GraspSpec>& grasps, const std::string& file);
void write_planned_grasps(const std::vector<GraspSpec>& grasps, const std::filesystem::path& path);

}  // namespace clench
