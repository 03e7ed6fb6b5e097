// A file read and written as another format.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"
#include "clench/io/write_world.h"

namespace clench {

struct GraspConversion {
  std::string format = {};                  ///< as write_grasp_file takes it
  std::vector<std::string> dof_names = {};  ///< of grasps that do not name their DOFs
};

/// A body, a robot, eigengrasps, virtual contacts or grasps in the file `from` written to `to`, whose
/// ending says how. Both warn: of what is not known, of what the new format cannot hold.
/// A world is not converted here: it is built, and saved.
/// grasps  format of a list of grasps, when the ending does not say it; and names of its DOFs, when
///         the file does not
/// throws Error when it is another kind, one cannot be read, or the other cannot hold it; nothing
/// is written then
void convert_file(FileKind kind, const std::filesystem::path& from, const std::filesystem::path& to,
                  const ReadOptions& reading, const WriteOptions& writing,
                  const GraspConversion& grasps = {});

/// Is it a list of grasps?
bool is_grasp_list(FileKind kind);

}  // namespace clench
