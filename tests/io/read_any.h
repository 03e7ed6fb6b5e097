// Reads a file of any kind, which its name and its first characters determine.
#pragma once
#include "clench/io/grasp_lines.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/read/read.h"
#include "clench/io/text/file_kind.h"

namespace clench::test {

inline void read_any(const std::filesystem::path& file, const ReadOptions& options = {}) {
  switch (file_kind(file)) {
    case FileKind::world:
      read_world(file, options);
      break;
    case FileKind::robot:
      read_robot(file, options);
      break;
    case FileKind::body:
      read_body(file, options);
      break;
    case FileKind::eigengrasps:
      read_eigengrasps(file, options);
      break;
    case FileKind::virtual_contacts:
      read_virtual_contacts(file, options);
      break;
    case FileKind::object_contacts:
      read_object_contacts(file, options);
      break;
    case FileKind::pregrasps:
      read_pregrasps(file, options);
      break;
    case FileKind::planned_grasps:
      read_planned_grasps(file, options);
      break;
    case FileKind::grasps:
      read_grasps(file, options);
      break;
    case FileKind::glove_calibration:
      read_glove_calibration(file, options);
      break;
    case FileKind::glove_poses:
      read_glove_poses(file, options);
      break;
  }
}

}  // namespace clench::test
