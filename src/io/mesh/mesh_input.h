// What every mesh reader is given.
#pragma once
#include <filesystem>
#include <string>

#include "clench/base/error.h"
#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"

namespace clench {

/// What a file of points without triangles means.
enum class BarePoints { refused, hull };

struct MeshInput {
  const std::filesystem::path& path;  ///< its name is shown in errors; files it names lie beside it
  const std::string& bytes;           ///< what the file holds
  const ReadOptions& options;
  GeometryFormat format = GeometryFormat::none;  ///< none: the one of the ending
  BarePoints bare_points = BarePoints::refused;

  std::string file() const { return path.filename().string(); }
  const Diagnostics& diagnostics() const { return options.diagnostics; }
};

/// Runs a reader of a scene, which has read() and warnings(); its sentences get the file's name.
/// returns  do colors come from the file?
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
    // what the builder refuses does not name the file
    const std::string what = error.what();
    if (what.starts_with(file)) throw;
    fail(error.kind(), "{}: {}", file, what);
  }
}

}  // namespace clench
