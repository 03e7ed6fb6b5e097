#include "script/library.h"

#include "script/bind_log.h"
#include "script/bind_pose.h"
#include "script/bind_units.h"
#include "script/bind_vec3.h"

namespace clench {

// a binding is one line in each list that it belongs to

std::span<const Library* const> all_libraries() {
  static const Library* const libraries[] = {
      &units_library,
      &vec3_library,
      &pose_library,
      &log_library,
  };
  return libraries;
}

std::span<const Class* const> all_classes() {
  static const Class* const classes[] = {
      &vec3_class,
      &pose_class,
  };
  return classes;
}

}  // namespace clench
