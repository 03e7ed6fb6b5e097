// What a format would not give back of a grasp.
#pragma once
#include <string>

#include "clench/io/grasps/grasp_format.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// The first part of the grasp that the format holds and that `back`, as it was read, has otherwise:
/// "the label 'note'"; empty: there is none. Poses of graspgen and of graspit are compared up to the
/// rounding of matrices and millimetres.
std::string difference(const GraspSpec& grasp, const GraspSpec& back, GraspFormat format);

}  // namespace clench
