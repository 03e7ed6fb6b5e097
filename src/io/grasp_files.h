// Reads and writes lists of grasps in all supported formats, selected by the ending or an option.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "clench/io/grasps/grasp_format.h"
#include "clench/io/text/grasp_sink.h"
#include "clench/io/text/read_options.h"
#include "clench/io/text/write_options.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// "jsonl", "csv", "npz", "isaac_grasp", "graspgen", "multigripper", "graspit"
/// throws Error  "unknown format 'cvs', expected one of jsonl, csv, ..."
GraspFormat grasp_format(const std::string& name);

/// The format in which write_grasp_file writes; `format` as for write_grasp_file.
/// throws Error  "a.json: .json may be several formats; expected ..."
GraspFormat grasp_format_to_write(const std::filesystem::path& path,
                                  const std::string& format = {});
/// "jsonl" and so on, as accepted by grasp_format
const char* grasp_format_name(GraspFormat format);

/// format  empty: determined by the ending, for .json and unknown endings by the contents
/// throws Error as the readers of the formats do
std::vector<GraspSpec> read_grasp_file(const std::filesystem::path& path,
                                       const std::string& format = {},
                                       const ReadOptions& options = {});

/// The same, but passes the grasps on one by one.   returns  the file's format
GraspFormat read_grasp_file(const std::filesystem::path& path, const GraspSink& sink,
                            const std::string& format = {}, const ReadOptions& options = {});

/// format  empty: .jsonl, .csv, .npz, .yaml and .yml (isaac_grasp) by their endings, JSON lines
///         without an ending; required for .json and all others
/// Warns of properties that a format does not hold: of options.notes in all but JSON lines. The
/// text is read back before it is saved.
/// throws Error if something that the format holds would read back differently
void write_grasp_file(const std::vector<GraspSpec>& grasps, const std::filesystem::path& path,
                      const std::string& format = {}, const WriteOptions& options = {});

}  // namespace clench
