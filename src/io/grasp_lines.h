// Lists of grasps as JSON lines: the first line names the kind of file, each following line holds
// one grasp.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "clench/io/text/grasp_sink.h"
#include "clench/io/text/read_options.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Numbers are read back bit-exactly. A last line without a line end that is not valid JSON is
/// skipped with a warning: writing it was interrupted.
/// throws Error  "grasps.jsonl:3: points[2].mu: expected a number >= 0, got -1"
std::vector<GraspSpec> read_grasps(const std::filesystem::path& path,
                                   const ReadOptions& options = {});

/// The same from a text; `file` is the name shown in errors.
void read_grasps(const std::string& file, std::string text, const GraspSink& sink,
                 const ReadOptions& options);

/// Equal lists give equal bytes. Measures and notes that are not finite are left out.
/// notes  notes on the list, a JSON object for its first line; empty: none
/// throws Error as write_file does
void write_grasps(const std::vector<GraspSpec>& grasps, const std::filesystem::path& path,
                  const std::string& notes = {});

/// The text of such a file.
std::string grasps_text(const std::vector<GraspSpec>& grasps, const std::string& notes = {});

/// The line of one grasp in such a file, without its line end; and the first line of the file.
std::string grasp_line(const GraspSpec& grasp);
std::string grasps_head(const std::string& notes = {});

}  // namespace clench
