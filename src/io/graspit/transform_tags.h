// Transforms in XML elements, which also occur inside text files.
#pragma once
#include "clench/base/text.h"
#include "clench/io/graspit/transform_list.h"
#include "clench/io/text/xml.h"
#include "clench/math/pose.h"

namespace clench {

/// The transform given by an element <tag>value</tag>: translation "x y z" [mm], rotation "degrees
/// axis", rotationMatrix (9 numbers), fullTransform "(w x y z)[x y z]".
/// throws Error at the line for other tags
Pose read_transform_element(const Line& line, std::string_view tag, std::string_view value,
                            const Diagnostics& diagnostics = {});

/// `<transform> <fullTransform>(w x y z)[x y z]</fullTransform> ... </transform>`, or one of the
/// inner elements alone, composed left to right. `line` is the first line; reads on to the closing
/// tag.
Pose read_tagged_transform(const Line& line, LineReader& lines,
                           const Diagnostics& diagnostics = {});

/// The child <transform> of an element, or identity if there is none.
/// throws Error at the line of any content that is not part of a transform
Pose read_transform_of(const XmlElement& element, const Diagnostics& diagnostics);

}  // namespace clench
