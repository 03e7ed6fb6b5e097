// Lists of grasps as comma-separated values (RFC 4180): one row per grasp, names and units in the
// head.
#pragma once
#include <filesystem>

#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/text/read_options.h"

namespace clench {

/// Columns: hand, object and their files; planner, seed, epsilon, energy; x y z [m], qw qx qy qz:
/// the hand's base in the object; "dof NAME [rad]" or [m]; other "measure NAME", "info NAME",
/// "label NAME". What a grasp does not have is empty. Numbers keep their digits, text that looks
/// like a number is quoted.
/// throws Error as write_file does
void write_grasp_table(const std::vector<GraspSpec>& grasps, const std::filesystem::path& path,
                       const WriteOptions& options);

/// throws Error  "g.csv:3: qw: expected a number, got 'x'"
std::vector<GraspSpec> read_grasp_table(const std::filesystem::path& path,
                                        const ReadOptions& options);

}  // namespace clench
