// Reads and writes eigengrasps: the text files (.egr) and the XML files of GraspIt!
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/eigengrasp_spec.h"

namespace clench {

/// `path` as returned by find_file; the contents determine whether it is text or XML. Vectors are
/// stored as written, including origin and norm: angles in radians, lengths in meters, like the
/// DOFs.
/// throws Error  "hand.egr:5: eigengrasp 2: expected a number, got 'x'"
EigengraspSet read_eigengrasps(const std::filesystem::path& path, const ReadOptions& options = {});

/// The text of an .xml file.
std::string eigengrasps_xml(const EigengraspSet& set);

/// The text of a file of that name, .egr or .xml; numbers have the digits needed to read them back
/// bit-exactly.   throws Error if the ending is another one
std::string eigengrasps_text(const EigengraspSet& set, const std::filesystem::path& path);

/// Warns if there are limits and the file is an .egr, which does not hold them.
/// throws Error as eigengrasps_text, or if the file cannot be written
void write_eigengrasps(const EigengraspSet& set, const std::filesystem::path& path,
                       const Diagnostics& diagnostics = {});

}  // namespace clench
