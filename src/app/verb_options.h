// Command-line options that are shared by several verbs or have long definitions.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "clench/app/verbs.h"

namespace clench {

/// A non-empty path.
extern const CLI::Validator named;

void add_confine(CLI::App& verb, std::string& folder);
void add_reading(CLI::App& verb, ReadingOptions& reading);
void add_world_reading(CLI::App& verb, ReadingOptions& reading);  ///< only options of worlds

/// Options of `clench plan`, `render`, `serve`, `mcp` and `view`: each given option appends its name and
/// its value to the words.
/// plans  whether the verb may be `plan`; otherwise the options of its planner are left out, because
///        reading their description starts Lua
void add_plan_options(CLI::App& verb, std::vector<std::string>& words, bool plans);
void add_render_options(CLI::App& verb, std::vector<std::string>& words);
void add_serve_options(CLI::App& verb, std::vector<std::string>& words);
void add_mcp_options(CLI::App& verb, std::vector<std::string>& words);
void add_view_options(CLI::App& verb, std::vector<std::string>& words);

}  // namespace clench
