#include "clench/io/convert.h"

#include <cassert>

#include "clench/base/error.h"
#include "clench/io/grasp_files.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/read/read.h"
#include "clench/io/write/write_body.h"
#include "clench/io/write/write_robot.h"

namespace clench {

namespace fs = std::filesystem;

bool is_grasp_list(FileKind kind) {
  return kind == FileKind::grasps || kind == FileKind::planned_grasps;
}

static void convert_grasps(FileKind kind, const fs::path& from, const fs::path& to,
                           const ReadOptions& reading, const WriteOptions& writing,
                           const GraspConversion& how) {
  auto list = read_grasp_file(from, kind == FileKind::planned_grasps ? "graspit" : "", reading);
  for (GraspSpec& g : list) {
    if (!g.dof_names.empty() || g.dofs.empty() || how.dof_names.empty()) continue;
    if (how.dof_names.size() != g.dofs.size())
      fail("{}: expected as many names as there are DOFs, {}, got {}", from.filename().string(),
           g.dofs.size(), how.dof_names.size());
    g.dof_names = how.dof_names;
  }
  write_grasp_file(list, to, how.format, writing);
}

void convert_file(FileKind kind, const fs::path& from, const fs::path& to,
                  const ReadOptions& reading, const WriteOptions& writing,
                  const GraspConversion& grasps) {
  switch (kind) {
    case FileKind::body:
      return write_body(read_body(from, reading), to, writing);
    case FileKind::robot:
      return write_robot(read_robot(from, reading), to, writing);
    case FileKind::world:
      assert(!"worlds are built and saved");
      break;
    case FileKind::eigengrasps:
      return write_eigengrasps(read_eigengrasps(from, reading), to, writing.diagnostics);
    case FileKind::virtual_contacts:
      return write_virtual_contacts(read_virtual_contacts(from, reading), to);
    case FileKind::grasps:
    case FileKind::planned_grasps:
      return convert_grasps(kind, from, to, reading, writing, grasps);
    default:
      fail("{}: expected a model, a world, eigengrasps, virtual contacts or grasps, got {}",
           from.filename().string(), kind_name(kind));
  }
}

}  // namespace clench
