// Input of all mesh readers.
#pragma once
#include <filesystem>
#include <string>

#include "clench/base/error.h"
#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"

namespace clench {

/// How to treat a file of points without triangles.
enum class BarePoints { refused, hull };

struct MeshInput {
  /// its name is shown in errors; files that it names are relative to its folder
  const std::filesystem::path& path;
  const std::string& bytes;  ///< contents of the file
  const ReadOptions& options;
  GeometryFormat format = GeometryFormat::none;  ///< none: determined by the ending
  BarePoints bare_points = BarePoints::refused;

  std::string file() const { return path.filename().string(); }
  const Diagnostics& diagnostics() const { return options.diagnostics; }
};

/// Runs a reader of a scene, which has read() and warnings(); prepends the file's name to its
/// messages.
/// returns  true if colors come from the file
template <class MakeReader>
bool run_reader(const MeshInput& input, MakeReader make) {
  const std::string file = input.file();
  try {
    auto reader = make();
    const bool colors = reader.read();
    for (const auto& warning : reader.warnings())
      input.diagnostics().warn(Place(file), "{}", warning);
    return colors;
  } catch (const Error& error) {
    // errors of the builder do not name the file
    const std::string what = error.what();
    if (what.starts_with(file)) throw;
    fail(error.kind(), "{}: {}", file, what);
  }
}

}  // namespace clench
