// Worlds as text in the supported formats.
#pragma once
#include <string>

#include "clench/io/write/saved_files.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// .wld of GraspIt! up to 2.0.
std::string wld_text(const WorldSpec& world, SavedFiles& files);
/// .xml of GraspIt! 2.1 and later.
std::string world_xml_text(const WorldSpec& world, SavedFiles& files);
/// A script for clench.load.
std::string text_of_lua(const WorldSpec& world, SavedFiles& files);

}  // namespace clench
