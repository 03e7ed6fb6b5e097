// Columns of a table of grasps for single parts of a grasp: the pose of its pregrasp, settings of
// its measurement, its contacts.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/spec/grasp_spec.h"

namespace clench {

/// Names of these columns in order: "pregrasp x [m]", ..., "contacts".
std::vector<std::string> part_column_names();

/// Cells of a grasp by names of columns, as plain text; without those of missing parts.
std::vector<std::pair<std::string, std::string>> part_cells(const GraspSpec& grasp);

/// Reads the cells of one grasp.
class PartReader {
 public:
  /// column  index in part_column_names()
  /// place   for errors: "g.csv:3: rho [m]"
  /// throws  Error  "g.csv:3: rho [m]: expected a number > 0, got '-1'"
  void read(size_t column, std::string_view text, const std::string& place);
  /// Adds the parts to the grasp; call once, after the DOFs of the pregrasp are set.
  /// throws  Error if the pose of the pregrasp is incomplete
  void finish(GraspSpec& grasp, const std::string& place);

 private:
  GraspSpec parts_;
  double pregrasp_[7] = {};
  int pregrasp_cells_ = 0;
  std::vector<size_t> seen_;
};

}  // namespace clench
