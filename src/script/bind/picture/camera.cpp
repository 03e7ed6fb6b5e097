#include <cmath>

#include "clench/base/error.h"
#include "clench/math/axes.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/spec/valid.h"

namespace clench {

// default height angle of a perspective camera of Inventor: 45 degrees
static constexpr double inventor_field_of_view = 0.7853981633974483;

int get_camera(lua_State* L) {
  const auto& camera = self<WorldHandle>(L).world->camera();
  if (!camera) return push_nil(L);
  return push_record(L, {{"eye", camera->X_WC.position},
                         {"target", camera->X_WC * Eigen::Vector3d(0, 0, -camera->focal_distance)},
                         {"up", camera->X_WC.rotation * Eigen::Vector3d::UnitY()},
                         {"field_of_view", inventor_field_of_view}});
}

Pose camera_pose(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                 const Eigen::Vector3d& up, const std::string& subject) {
  const Eigen::Vector3d back = eye - target;
  const auto rotation = rotation_from_axes(2, back, 1, up);
  if (!(back.norm() > 1e-9) || !rotation)
    fail("{}: expected different eye and target, and up in another direction than the view",
         subject);
  const Pose pose{*rotation, eye};
  check_place(pose, subject);
  return pose;
}

static Camera looking(Table& options) {
  const Eigen::Vector3d eye = options.vec3("eye"), target = options.vec3("target");
  const Pose pose =
      camera_pose(eye, target, options.vec3("up", Eigen::Vector3d::UnitZ()), options.subject());
  const double angle = options.number("field_of_view", inventor_field_of_view);
  if (std::abs(angle - inventor_field_of_view) > 1e-9)
    fail("{}: field_of_view: expected {}, that of every camera of a world, got {}",
         options.subject(), inventor_field_of_view, angle);
  return {pose, (eye - target).norm()};
}

int set_camera(lua_State* L) {
  World& world = *self<WorldHandle>(L).world;
  if (!given(L, 2)) {
    world.set_camera({});
    return 0;
  }
  Table options(L, 2);
  Camera camera;
  if (options.has("pose")) {
    camera.X_WC = options.pose("pose");
    camera.focal_distance = options.number("focal_distance", camera.focal_distance);
  } else {
    camera = looking(options);
  }
  options.done();
  world.set_camera(camera);
  return 0;
}

}  // namespace clench
