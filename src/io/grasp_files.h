// Lists of grasps in files of every format that holds them; the ending, or an option, says which.
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
const char* grasp_format_name(GraspFormat format);

/// format  empty: what the ending says, and of .json and others what stands in the file
/// throws Error as the readers of the formats do
std::vector<GraspSpec> read_grasp_file(const std::filesystem::path& path,
                                       const std::string& format = {},
                                       const ReadOptions& options = {});

/// The same, one grasp after the other.   returns  the file's format
GraspFormat read_grasp_file(const std::filesystem::path& path, const GraspSink& sink,
                            const std::string& format = {}, const ReadOptions& options = {});

/// format  empty: .jsonl, .csv, .npz, .yaml and .yml (isaac_grasp) by their endings, JSON lines
///         without one; of .json and others it has to be given
/// Warns of what a format does not hold. The text is read back before it is saved.
/// throws Error when something that the format holds would read back differently
void write_grasp_file(const std::vector<GraspSpec>& grasps, const std::filesystem::path& path,
                      const std::string& format = {}, const WriteOptions& options = {});

}  // namespace clench
