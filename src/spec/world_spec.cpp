#include "clench/spec/world_spec.h"

namespace clench {

void check_camera(const Camera& camera, std::string_view subject) {
  check_place(camera.X_WC, subject);
  check(length_rule.called("focal distance"), camera.focal_distance, subject);
}

}  // namespace clench
