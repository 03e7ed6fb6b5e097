#include "io/convert.h"

#include "base/error.h"
#include "io/eigengrasps.h"
#include "io/virtual_contacts.h"
#include "io/write_body.h"
#include "io/write_robot.h"

namespace clench {

namespace fs = std::filesystem;

void convert_file(FileKind kind, const fs::path& from, const fs::path& to,
                  const ReadOptions& reading, const WriteOptions& writing) {
  std::error_code code;
  if (fs::equivalent(from, to, code))
    fail("{}: wanted another file to write, got the same", to.generic_string());
  switch (kind) {
    case FileKind::body:
      return write_body(read_body(from, reading), to, writing);
    case FileKind::robot:
      return write_robot(read_robot(from, reading), to, writing);
    case FileKind::world:
      return write_world(read_world(from, reading), to, writing);
    case FileKind::eigengrasps:
      return write_eigengrasps(read_eigengrasps(from, reading), to, writing.warn);
    case FileKind::virtual_contacts:
      return write_virtual_contacts(read_virtual_contacts(from, reading), to);
  }
}

}  // namespace clench
