// Reads properties of a robot that URDF cannot express from the custom element <clench>, which
// other readers ignore.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/text/xml.h"

namespace clench {

/// Adds the properties in the element to the robot: closing directions, materials, springs,
/// approach, collision rules, actuators; and the files that it names.
/// `robot` is the result of its links and joints; `path` is its file
/// throws  Error "hand.urdf:31: dof: no joint 'thum' that leads a DOF; did you mean 'thumb'?" for
///         any unknown content
void read_clench_element(const XmlElement& element, RobotSpec& robot,
                         const std::filesystem::path& path, const FileCache& cache);

}  // namespace clench
