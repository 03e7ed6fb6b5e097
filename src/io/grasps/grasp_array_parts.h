// Arrays of an .npz file of grasps in addition to poses and DOFs: joints, further postures,
// contacts, settings of the measurement, measures, notes and labels.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "clench/io/grasps/npz.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

using NamedArrays = std::map<std::string, NpyArray>;

/// True if one array can hold the joints of all grasps: each grasp has the same joints, or none.
bool has_same_joints(const std::vector<GraspSpec>& grasps);

/// Adds the following arrays for n grasps of d DOFs and j joints, if any grasp has such values:
/// `joints` n x j with `joint_names`, `joint_units` and `joint_offsets` (j); `pregrasp_poses` n x
/// 7, `pregrasp_dofs` and `squeeze_dofs` n x d; `com` n x 3, `rho`, `largest_radius`,
/// `gyration_radius`, `edges`, `soft`, `moduli` (n), `normal_force` n x m; for the contacts of all
/// grasps in sequence `contact_grasps`, `contact_points`, `contact_normals`, `contact_mu`,
/// `contact_torsion_radius`, `contact_links`; `hand_files`, `object_files`, `measure_NAME`,
/// `info_NAME`, `label_NAME` (n). Missing numbers are NaN.
void add_array_parts(const std::vector<GraspSpec>& grasps, NamedArrays& out);

/// Reads the same arrays, grasp by grasp.
class ArrayParts {
 public:
  /// throws  Error  "g.npz: joints: expected 3 x j numbers, got 2 x 5" for another shape
  ArrayParts(const std::string& file, const NamedArrays& arrays, size_t grasps, size_t dofs);
  /// Sets the parts of grasp i, whose pose and DOFs must be set.
  void read(size_t i, GraspSpec& out) const;
  /// True for the arrays that this class reads.
  static bool knows(const std::string& name);

 private:
  const NpyArray* numbers(const char* name, size_t columns, size_t rows) const;
  const NpyArray* texts(const std::string& name, size_t rows) const;
  void read_joints(size_t i, GraspSpec& out) const;
  void read_postures(size_t i, GraspSpec& out) const;
  void read_measured(size_t i, GraspSpec& out) const;
  void read_named(size_t i, GraspSpec& out) const;
  void check_shapes() const;

  const std::string& file_;
  const NamedArrays& arrays_;
  size_t count_, dofs_;
  std::vector<std::vector<size_t>> contacts_;  // contact indices per grasp
};

/// "3 x 4", "a single value", "2 texts"
std::string shape_text(const NpyArray& array);

}  // namespace clench
