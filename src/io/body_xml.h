// Bodies from the XML files of GraspIt! 2.1 and later.
#pragma once
#include "io/library.h"
#include "io/xml.h"

namespace clench {

/// A file whose outermost element, of any name, holds material, mass, geometryFile and the like.
/// throws Error  "mug.xml:4: mass: wanted a number > 0 [g], got -2"
BodySpec read_body_xml(const std::filesystem::path& path, Library& library);

/// An element with such children; geometry is looked for beside `path`. Leaves name, source and file
/// to the caller.
BodySpec read_body_element(const XmlElement& element, const std::filesystem::path& path,
                           Library& library);

}  // namespace clench
