// Arrays of an .npz of grasps beside their poses and DOFs: joints, further postures, contacts, how
// the grasps were measured, measures, notes and labels.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "clench/io/grasps/npz.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

using NamedArrays = std::map<std::string, NpyArray>;

/// Can one array hold the joints of all grasps? They have the same joints, or none.
bool has_same_joints(const std::vector<GraspSpec>& grasps);

/// Adds, for n grasps of d DOFs and j joints, those of these that any grasp has: `joints` n x j
/// with `joint_names`, `joint_units` and `joint_offsets` (j); `pregrasp_poses` n x 7,
/// `pregrasp_dofs` and `squeeze_dofs` n x d; `com` n x 3, `rho`, `largest_radius`,
/// `gyration_radius`, `edges`, `soft`, `moduli` (n), `normal_force` n x m; of all contacts in a row
/// `contact_grasps`, `contact_points`, `contact_normals`, `contact_mu`, `contact_torsion_radius`,
/// `contact_links`; `hand_files`, `object_files`, `measure_NAME`, `info_NAME`, `label_NAME` (n).
/// Missing numbers are NaN.
void add_array_parts(const std::vector<GraspSpec>& grasps, NamedArrays& out);

/// Reads the same arrays, grasp by grasp.
class ArrayParts {
 public:
  /// throws  Error  "g.npz: joints: expected 3 x j numbers, got 2 x 5" for another shape
  ArrayParts(const std::string& file, const NamedArrays& arrays, size_t grasps, size_t dofs);
  /// Sets the parts of grasp i, whose pose and DOFs are known.
  void read(size_t i, GraspSpec& out) const;
  /// Is it an array that this class reads?
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
  std::vector<std::vector<size_t>> contacts_;  // numbers of those of each grasp
};

/// "3 x 4", "a single value", "2 texts"
std::string shape_text(const NpyArray& array);

}  // namespace clench
