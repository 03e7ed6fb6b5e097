// Rigid transforms as the text files write them: t, r, rr, T, R lines, and (w x y z)[x y z].
#pragma once
#include "clench/base/diagnostic.h"
#include "clench/base/text.h"
#include "clench/math/pose.h"

namespace clench {

/// Does the line begin with t, T, r or R, as the lines of a transform list do?
bool begins_transform(const Line& line);

/// "(w x y z)[x y z]", millimeters; the quaternion is made unit, with a warning when it is not
/// near; a comment from '#' on is left out.
/// throws Error with the line's place when it is anything else, or the quaternion is zero
Pose read_full_transform(const Line& line, std::string_view text,
                         const Diagnostics& diagnostics = {});

/// One entry of a list: `t x y z` [mm], `r degrees axis`, `rr radians axis`, `T (w x y z)[x y z]`,
/// or `R` and nine numbers, the images of the axes, on this line and the next ones.
Pose read_transform(const Line& line, LineReader& lines, const Diagnostics& diagnostics = {});

/// Entries up to the first line that is none, composed left to right; identity when there are none.
Pose read_transform_list(LineReader& lines, const Diagnostics& diagnostics = {});

}  // namespace clench
