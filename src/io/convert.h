// Reads a file and writes it in another format.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"
#include "clench/io/write/write_world.h"

namespace clench {

struct GraspConversion {
  std::string format = {};                  ///< as for write_grasp_file
  std::vector<std::string> dof_names = {};  ///< for grasps that do not name their DOFs
};

/// Reads the body, robot, eigengrasps, virtual contacts or grasps in the file `from` and writes
/// them to `to`, whose ending selects the format. Warns of unknown contents and of properties that
/// the new format cannot hold. Worlds are not converted here: they are built and saved.
/// grasps  format of a list of grasps, if the ending does not determine it; and names of its DOFs,
///         if the file does not give them
/// throws Error if the file is of another kind, a file cannot be read, or the new format cannot
/// hold it; nothing is written then
void convert_file(FileKind kind, const std::filesystem::path& from, const std::filesystem::path& to,
                  const ReadOptions& reading, const WriteOptions& writing,
                  const GraspConversion& grasps = {});

/// True for a list of grasps.
bool is_grasp_list(FileKind kind);

}  // namespace clench
