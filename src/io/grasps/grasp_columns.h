// Columns of a table of grasps that hold one part of a grasp each: the pose of its pregrasp, how it
// was measured, its contacts.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/spec/grasp_spec.h"

namespace clench {

/// Names of these columns, in their order: "pregrasp x [m]", ..., "contacts".
std::vector<std::string> part_column_names();

/// Cells of a grasp by the names of their columns, as plain text; parts that it lacks have none.
std::vector<std::pair<std::string, std::string>> part_cells(const GraspSpec& grasp);

/// Reads the cells of one grasp.
class PartReader {
 public:
  /// column  its place among part_column_names()
  /// place   for errors: "g.csv:3: rho [m]"
  /// throws  Error  "g.csv:3: rho [m]: expected a number > 0, got '-1'"
  void read(size_t column, std::string_view text, const std::string& place);
  /// Adds what was read; call once, after the DOFs of pregrasps.
  /// throws  Error where the pose of a pregrasp is incomplete
  void finish(GraspSpec& grasp, const std::string& place);

 private:
  GraspSpec parts_;
  double pregrasp_[7] = {};
  int pregrasp_cells_ = 0;
  std::vector<size_t> seen_;
};

}  // namespace clench
