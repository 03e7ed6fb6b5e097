#include "clench/io/convert.h"

#include <cassert>

#include "clench/base/error.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/read.h"
#include "clench/io/write_body.h"
#include "clench/io/write_robot.h"

namespace clench {

namespace fs = std::filesystem;

void convert_file(FileKind kind, const fs::path& from, const fs::path& to,
                  const ReadOptions& reading, const WriteOptions& writing) {
  switch (kind) {
    case FileKind::body:
      return write_body(read_body(from, reading), to, writing);
    case FileKind::robot:
      return write_robot(read_robot(from, reading), to, writing);
    case FileKind::world:
      assert(!"worlds are built and saved");
      break;
    case FileKind::eigengrasps:
      return write_eigengrasps(read_eigengrasps(from, reading), to, writing.warn);
    case FileKind::virtual_contacts:
      return write_virtual_contacts(read_virtual_contacts(from, reading), to);
    default:
      fail("{}: expected a model, a world, eigengrasps or virtual contacts, got {}",
           from.filename().string(), kind_name(kind));
  }
}

}  // namespace clench
