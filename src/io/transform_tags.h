// Transforms as the XML files write them, where they stand in a text file.
#pragma once
#include "base/text.h"
#include "io/transform_list.h"
#include "math/pose.h"

namespace clench {

/// `<transform> <fullTransform>(w x y z)[x y z]</fullTransform> ... </transform>`, or one of the
/// inner elements alone: translation "x y z" [mm], rotation "degrees axis", rotationMatrix (9
/// numbers), fullTransform. Composed left to right. `line` is the first line; reads on to the
/// closing tag.
Pose read_tagged_transform(const Line& line, LineReader& lines, const TransformWarning& warn = {});

}  // namespace clench
