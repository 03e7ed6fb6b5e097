// Lists of grasps as comma-separated values (RFC 4180): one row per grasp, with names and units in
// the header row.
#pragma once
#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/text/grasp_sink.h"
#include "clench/io/text/read_options.h"

namespace clench {

/// Columns: hand, object and their files; planner, seed, epsilon, energy; x y z [m], qw qx qy qz:
/// the hand's base in the object; "dof NAME [rad]" or [m], or "dof_1 [rad]" for DOFs without names;
/// "joint NAME [rad]", "pregrasp dof NAME [rad]", "squeeze dof NAME [rad]"; those of
/// part_column_names(); other "measure NAME", "info NAME", "label NAME". Cells are empty for
/// missing values and for numbers that are not finite. Numbers are written with all digits; text
/// that looks like a number is quoted.
std::string grasp_table_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                             const WriteOptions& options);

/// throws Error  "g.csv:3: qw: expected a number, got 'x'"
void read_grasp_table(const std::string& file, std::string_view text, const GraspSink& sink,
                      const ReadOptions& options);

}  // namespace clench
