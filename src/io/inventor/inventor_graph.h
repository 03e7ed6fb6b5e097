// Inventor and VRML files as graphs of nodes, with the files that they include in their places.
#pragma once
#include <filesystem>

#include "clench/io/inventor/inventor_nodes.h"
#include "clench/io/text/read_options.h"

namespace clench {

/// Files included, each counted as often as it is named: far above what models name.
inline constexpr size_t max_includes = 10'000;

/// The graph of a file that holds `text`. Nodes of unknown types are stepped over with a warning,
/// nodes that have no part in triangles, colors, units and transforms without one. A PROTO's body
/// is read again for each of its instances, with their values.
/// throws Error  "box.iv:31: ..." when the file or one that it includes is malformed, missing,
/// includes itself or is larger than files may be
InventorGraph read_inventor_graph(const std::filesystem::path& path, const std::string& text,
                                  const ReadOptions& options);

}  // namespace clench
