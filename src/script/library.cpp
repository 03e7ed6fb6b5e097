#include "script/library.h"

#include "script/bind_body.h"
#include "script/bind_catalog.h"
#include "script/bind_chart.h"
#include "script/bind_contact.h"
#include "script/bind_convert.h"
#include "script/bind_eigengrasps.h"
#include "script/bind_entries.h"
#include "script/bind_files.h"
#include "script/bind_forces.h"
#include "script/bind_grasp.h"
#include "script/bind_grasps.h"
#include "script/bind_hand.h"
#include "script/bind_json.h"
#include "script/bind_log.h"
#include "script/bind_measures.h"
#include "script/bind_mesh.h"
#include "script/bind_patch.h"
#include "script/bind_pose.h"
#include "script/bind_progress.h"
#include "script/bind_projection.h"
#include "script/bind_random.h"
#include "script/bind_render.h"
#include "script/bind_units.h"
#include "script/bind_vec3.h"
#include "script/bind_virtual_contact.h"
#include "script/bind_wrench_space.h"
#include "script/handles.h"

namespace clench {

// a binding is one line in each list that it belongs to

std::span<const Library* const> all_libraries() {
  static const Library* const libraries[] = {
      &units_library,        &vec3_library,        &pose_library,    &random_library,
      &catalog_library,      &convert_library,     &entries_library, &json_library,
      &log_library,          &world_library,       &grasp_library,   &measures_library,
      &wrench_space_library, &eigengrasps_library, &files_library,   &render_library,
      &chart_library,        &progress_library,    &grasps_library,
  };
  return libraries;
}

std::span<const Class* const> all_classes() {
  static const Class* const classes[] = {
      &vec3_class,     &pose_class,         &random_class,      &world_class,
      &snapshot_class, &entity_class,       &body_class,        &mesh_class,
      &hand_class,     &robot_class,        &eigengrasps_class, &virtual_contact_class,
      &contact_class,  &forces_class,       &measures_class,    &patch_class,
      &grasp_class,    &wrench_space_class, &projection_class,  &picture_class,
      &progress_class, &grasps_class,
  };
  return classes;
}

}  // namespace clench
