// Finds parts of a grasp that a format does not preserve.
#pragma once
#include <string>

#include "clench/io/grasps/grasp_format.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Compares a grasp with `back`, which was read from the format's text. For graspgen and graspit,
/// poses are compared up to the rounding of matrices and millimeters.
/// returns  the first part that the format holds and that differs, "the label 'note'"; empty if
///          none
std::string difference(const GraspSpec& grasp, const GraspSpec& back, GraspFormat format);

}  // namespace clench
