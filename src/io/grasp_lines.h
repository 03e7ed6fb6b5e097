// Lists of grasps as JSON lines: what kind of file it is on the first, a grasp on each that
// follows.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "clench/io/text/grasp_sink.h"
#include "clench/io/text/read_options.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Numbers come back to the bit. A last line that lacks its end and is no JSON is skipped with a
/// warning: it was cut short as it was written.
/// throws Error  "grasps.jsonl:3: points[2].mu: expected a number >= 0, got -1"
std::vector<GraspSpec> read_grasps(const std::filesystem::path& path,
                                   const ReadOptions& options = {});

/// The same from a text; `file` is the name shown in errors.
void read_grasps(const std::string& file, std::string text, const GraspSink& sink,
                 const ReadOptions& options);

/// The same list gives the same bytes. Measures and notes that are not finite are left out.
/// notes  of the list as such, a JSON object for its first line; empty: none
/// throws Error as write_file does
void write_grasps(const std::vector<GraspSpec>& grasps, const std::filesystem::path& path,
                  const std::string& notes = {});

/// The text of such a file.
std::string grasps_text(const std::vector<GraspSpec>& grasps, const std::string& notes = {});

/// What one grasp is in such a file, without the end of the line; and what its first line is.
std::string grasp_line(const GraspSpec& grasp);
std::string grasps_head(const std::string& notes = {});

}  // namespace clench
