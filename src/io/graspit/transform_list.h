// Rigid transforms in text files: t, r, rr, T, R lines, and (w x y z)[x y z].
#pragma once
#include "clench/base/diagnostic.h"
#include "clench/base/text.h"
#include "clench/math/pose.h"

namespace clench {

/// True if the line begins with t, T, r or R, like the lines of a transform list.
bool begins_transform(const Line& line);

/// "(w x y z)[x y z]", in millimeters; the quaternion is normalized, with a warning if its length
/// is not near 1; a comment from '#' on is ignored.
/// throws Error with the line's place for any other text, or if the quaternion is zero
Pose read_full_transform(const Line& line, std::string_view text,
                         const Diagnostics& diagnostics = {});

/// One entry of a list: `t x y z` [mm], `r degrees axis`, `rr radians axis`, `T (w x y z)[x y z]`,
/// or `R` and nine numbers, the images of the axes, on this line and the next ones.
Pose read_transform(const Line& line, LineReader& lines, const Diagnostics& diagnostics = {});

/// Entries up to the first other line, composed left to right; identity if there are none.
Pose read_transform_list(LineReader& lines, const Diagnostics& diagnostics = {});

}  // namespace clench
