// Named states of a world.
#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"
#include "clench/model/world.h"

namespace clench {

void World::set_gravity(const Eigen::Vector3d& gravity) {
  check(gravity_rule, gravity, "world");
  edit_settings().gravity = gravity;
}

// bounds that were read as decimals
static constexpr double rounding_of_bounds = 1e-9;

void World::add_keyframe(Keyframe keyframe) {
  const std::string subject = fmt::format("keyframe '{}'", excerpt(keyframe.name));
  if (keyframe.name.empty()) fail("keyframe: expected a name, got none");
  check_name(keyframe.name, "keyframe");
  for (const auto& placed : keyframe.bodies) {
    if (const Body& b = body(placed.body); b.robot)
      fail("{}: body '{}' is a part of robot '{}': place the robot", subject, excerpt(b.name),
           excerpt(robot(b.robot).name));
    check_place(placed.X_WB, fmt::format("{}: body '{}'", subject, body(placed.body).name));
  }
  for (auto& placed : keyframe.robots) {
    const Robot& r = robot(placed.robot);
    const std::string of = fmt::format("{}: robot '{}'", subject, excerpt(r.name));
    if (placed.X_WB) check_place(*placed.X_WB, of);
    if (placed.dofs.size() != r.dofs.size())
      fail("{}: expected {} DOF values, got {}", of, r.dofs.size(), placed.dofs.size());
    for (size_t d = 0; d < placed.dofs.size(); ++d) {
      double& q = placed.dofs[d];
      const auto [low, high] = range_around(r, static_cast<int>(d), q);
      if (!(q >= low - rounding_of_bounds && q <= high + rounding_of_bounds))
        fail("{}: DOF {}: expected a value in [{}, {}], got {}", of, d + 1, low, high, q);
      q = std::clamp(q, low, high);
    }
  }
  WorldSettings& settings = edit_settings();
  auto& all = settings.keyframes;
  const auto same = settings.keyframe_numbers.find(keyframe.name);
  if (same != settings.keyframe_numbers.end()) {
    all[same->second] = std::move(keyframe);
    return;
  }
  if (all.size() == all.capacity()) all.reserve(2 * all.size() + 1);
  settings.keyframe_numbers.emplace(keyframe.name, all.size());
  all.push_back(std::move(keyframe));
}

Keyframe World::current_keyframe(const std::string& name) const {
  Keyframe out{name, {}, {}};
  for (const auto id : bodies())
    if (!body(id).robot) out.bodies.push_back({id, pose(id)});
  for (const auto id : robots()) {
    const Values q = dofs(id);
    std::optional<Pose> X_WB;
    if (!robot(id).mounting) X_WB = pose(robot(id).base);
    out.robots.push_back({id, X_WB, {q.begin(), q.end()}});
  }
  return out;
}

void World::set_keyframe(std::string_view name) {
  const auto number = settings_->keyframe_numbers.find(name);
  if (number == settings_->keyframe_numbers.end()) {
    std::vector<std::string> names;
    for (const Keyframe& keyframe : keyframes()) names.push_back(keyframe.name);
    fail("no keyframe '{}' in this world{}", excerpt(name),
         names.empty() ? ", which has none" : instead_of(name, names));
  }
  const Keyframe* found = &keyframes()[number->second];
  // a carried robot moves with its parent
  for (const auto& placed : found->robots) {
    if (!alive(placed.robot)) continue;
    const Robot& r = robot(placed.robot);
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(
        placed.dofs.data(), static_cast<Eigen::Index>(placed.dofs.size()));
    const bool free = placed.X_WB && !r.mounting;
    set_joints(placed.robot, free ? *placed.X_WB : Pose(pose(r.base)), q, {});
  }
  for (const auto& placed : found->bodies)
    if (alive(placed.body)) set_pose(placed.body, placed.X_WB);
}

}  // namespace clench
