// A file read and written as another format.
#pragma once
#include "clench/io/text/file_kind.h"
#include "clench/io/text/find_file.h"
#include "clench/io/write_world.h"

namespace clench {

/// A body, a robot, eigengrasps or virtual contacts in the file `from` written to `to`, whose
/// ending says how. Both warn: of what is not known, of what the new format cannot hold.
/// A world is not converted here: it is built, and saved.
/// throws Error when it is another kind, one cannot be read, or the other cannot hold it; nothing
/// is written then
void convert_file(FileKind kind, const std::filesystem::path& from, const std::filesystem::path& to,
                  const ReadOptions& reading, const WriteOptions& writing);

}  // namespace clench
