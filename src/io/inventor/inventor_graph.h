// Inventor and VRML files as graphs of nodes, with included files in place of the nodes that name
// them.
#pragma once
#include <filesystem>

#include "clench/io/inventor/inventor_nodes.h"
#include "clench/io/text/read_options.h"

namespace clench {

/// Limit on included files, each counted every time it is named: far above the number in models.
inline constexpr size_t max_includes = 10'000;

/// The graph of a file that contains `text`. Nodes of unknown types are skipped with a warning;
/// nodes without effect on triangles, colors, units and transforms are skipped without one. The
/// body of a PROTO is parsed again for each instance, with the values of this instance.
/// throws Error  "box.iv:31: ..." if the file or an included one is malformed, missing, includes
/// itself or is too large
InventorGraph read_inventor_graph(const std::filesystem::path& path, const std::string& text,
                                  const ReadOptions& options);

}  // namespace clench
