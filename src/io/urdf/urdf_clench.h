// What a URDF cannot say of a robot and stands in an element <clench> of our own, which other
// readers ignore.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/text/xml.h"

namespace clench {

/// Gives the robot what the element says: how DOFs close, and what they are made of; materials,
/// springs, approach, collision rules, actuators; and the files that it names.
/// `robot` is what its links and joints make of it; `path` is its file
/// throws  Error "hand.urdf:31: dof: no joint 'thum' that leads a DOF; did you mean 'thumb'?" for
///         whatever in it is not understood
void read_clench_element(const XmlElement& element, RobotSpec& robot,
                         const std::filesystem::path& path, const FileCache& cache);

}  // namespace clench
