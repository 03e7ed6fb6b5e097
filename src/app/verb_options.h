// Options of the command line that several verbs share, or that need many lines.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "clench/app/verbs.h"

namespace clench {

/// A path, which is not empty.
extern const CLI::Validator named;

void add_confine(CLI::App& verb, std::string& folder);
void add_reading(CLI::App& verb, ReadingOptions& reading);
void add_world_reading(CLI::App& verb, ReadingOptions& reading);  ///< those of worlds alone

/// Options of `clench plan`, `render`, `serve` and `view`: each that is given adds its name and its value to
/// the words.
void add_plan_options(CLI::App& verb, std::vector<std::string>& words);
void add_render_options(CLI::App& verb, std::vector<std::string>& words);
void add_serve_options(CLI::App& verb, std::vector<std::string>& words);
void add_view_options(CLI::App& verb, std::vector<std::string>& words);

}  // namespace clench
