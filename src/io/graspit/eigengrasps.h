// Eigengrasps from and to files: the text files (.egr) and the XML files of GraspIt!
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/eigengrasp_spec.h"

namespace clench {

/// `path` as find_file gives it; text or XML, by what stands in it. Vectors are kept as written,
/// the origin and the norm too: angles in radians, lengths in meters, as the DOFs count.
/// throws Error  "hand.egr:5: eigengrasp 2: expected a number, got 'x'"
EigengraspSet read_eigengrasps(const std::filesystem::path& path, const ReadOptions& options = {});

/// The text of an .xml.
std::string eigengrasps_xml(const EigengraspSet& set);

/// The text of a file of that name, .egr or .xml; every number with the digits that give it back to
/// the bit.   throws Error when the ending is another one
std::string eigengrasps_text(const EigengraspSet& set, const std::filesystem::path& path);

/// The .egr has no limits: `warn` is told when there are some.
/// throws Error as eigengrasps_text, or when the file cannot be written
void write_eigengrasps(const EigengraspSet& set, const std::filesystem::path& path,
                       const Diagnostics& diagnostics = {});

}  // namespace clench
