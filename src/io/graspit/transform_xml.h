// Transforms as the elements of an XML file.
#pragma once
#include "clench/io/graspit/transform_list.h"
#include "clench/io/text/xml.h"
#include "clench/math/pose.h"

namespace clench {

/// The children of <transform>, composed left to right; see read_transform_element.
/// throws Error at the line of a child that is none
Pose read_transform_xml(const XmlElement& transform, const Listeners& listeners);

/// The child <transform> of an element, or identity when there is none.
Pose read_transform_of(const XmlElement& element, const Listeners& listeners);

}  // namespace clench
