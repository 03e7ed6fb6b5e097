// Lists of grasps as NumPy arrays, .npz.
#pragma once
#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/text/grasp_sink.h"
#include "clench/io/text/read_options.h"

namespace clench {

/// Arrays for n grasps and d DOFs: `poses` n x 7 (x y z [m], qw qx qy qz: the hand's base in the
/// object), `dofs` n x d [rad or m] with their `dof_names` and `dof_units` (d), if known,
/// `epsilon`, `energy`, `seed`, `collision_free` (1, 0) (n; NaN: not known), `hands`, `objects`,
/// `planners` (n); and those of add_array_parts().
/// throws Error if DOFs differ between grasps
std::string grasp_arrays_bytes(const std::vector<GraspSpec>& grasps, const std::string& file,
                               const WriteOptions& options);

/// `poses` may be n x 4 x 4 matrices; all other arrays are optional.
/// throws Error  "g.npz: poses: expected n x 7 or n x 4 x 4 numbers, got 3 x 6"
void read_grasp_arrays(const std::string& file, std::string_view bytes, const GraspSink& sink,
                       const ReadOptions& options);

/// throws Error  "place: expected a homogeneous matrix of a rotation and a translation"
Pose pose_of_matrix(const double* rows, const std::string& place);

}  // namespace clench
