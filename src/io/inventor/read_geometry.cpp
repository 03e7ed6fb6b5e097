#include "clench/io/inventor/read_geometry.h"

#include "clench/base/text.h"
#include "clench/io/inventor/inventor.h"
#include "clench/io/mesh/mesh_files.h"

namespace clench {

namespace fs = std::filesystem;

Geometry read_geometry(const fs::path& path, const ReadOptions& options, GeometryFormat format,
                       const std::string* text) {
  if (format == GeometryFormat::none) format = geometry_format(ending_of(path));
  if (format == GeometryFormat::none)
    fail("{}: expected geometry from {}, got {}", path.filename().string(),
         one_of(geometry_endings()), in_quotes(ending_of(path)));
  if (format == GeometryFormat::inventor)
    return read_inventor(path, text ? *text : read_text(path), options);
  return read_mesh_file(path, options, format);
}

}  // namespace clench
