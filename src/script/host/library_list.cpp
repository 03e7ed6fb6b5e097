#include "clench/script/host/library_list.h"

#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/planning/planning.h"
#ifdef CLENCH_VIEWER
#include "clench/script/bind/view/ui.h"
#endif
#include "clench/script/bind/world/contacts.h"
#include "clench/script/bind/world/meshes.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/host/job_classes.h"

namespace clench {

// to add a binding, add one line to each list that it belongs to

std::span<const Library* const> all_libraries() {
  static const Library* const libraries[] = {
      &units_library,        &vec3_library,        &pose_library,    &random_library,
      &catalog_library,      &convert_library,     &entries_library, &json_library,
      &log_library,          &world_library,       &grasp_library,   &measures_library,
      &wrench_space_library, &eigengrasps_library, &files_library,   &arrays_library,
      &film_library,         &render_library,      &chart_library,   &plot_library,
      &progress_library,     &grasps_library,      &energy_library,  &annealing_library,
      &parallel_library,     &job_library,
#ifdef CLENCH_VIEWER
      &ui_library,
#endif
  };
  return libraries;
}

std::span<const Class* const> all_classes() {
  static const Class* const classes[] = {
      &vec3_class,
      &pose_class,
      &random_class,
      &world_class,
      &snapshot_class,
      &entity_class,
      &body_class,
      &mesh_class,
      &hand_class,
      &kinematics_class,
      &dofs_class,
      &robot_class,
      &eigengrasps_class,
      &virtual_contact_class,
      &contact_class,
      &forces_class,
      &measures_class,
      &patch_class,
      &grasp_class,
      &wrench_space_class,
      &projection_class,
      &picture_class,
      &plot_class,
      &progress_class,
      &grasps_class,
      &energy_class,
      &job_class,
      &this_job_class,
      &annealing_class,
      &world_settings_class,
      &world_queries_class,
      &world_dynamics_class,
      &world_control_class,
      &motion_class,
      &joint_dynamics_class,
      &robot_dynamics_class,
#ifdef CLENCH_VIEWER
      &ui_class,
      &ui_widgets_class,
      &ui_plots_class,
      &ui_containers_class,
#endif
  };
  return classes;
}

}  // namespace clench
