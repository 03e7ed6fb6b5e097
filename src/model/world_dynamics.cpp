// Velocities, motors and welds of a world.
#include <algorithm>
#include <atomic>
#include <memory>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/world.h"

namespace clench {

void World::set_dynamic_settings(DynamicSettings settings) {
  check(time_step_rule, settings.step, "world");
  for (const auto& [id, robot] : settings.robots)
    if (robot.max_effort) check(positive_rule.called("largest effort"), *robot.max_effort, "robot");
  // settings with the initial values are not stored
  for (auto& [id, robot] : settings.robots)
    if (std::ranges::none_of(robot.gains, [](const auto& gains) { return gains.has_value(); }))
      robot.gains.clear();
  std::erase_if(settings.robots, [](const auto& of) { return of.second == RobotDynamics{}; });
  edit_settings().dynamics = std::move(settings);
}

DynamicState& World::edit_dynamics() {
  auto& shared = state_.dynamics;
  if (!shared)
    shared = std::make_shared<DynamicState>();
  else if (shared.use_count() > 1)
    shared = std::make_shared<DynamicState>(*shared);
  // the last other owner may have released it in another thread
  std::atomic_thread_fence(std::memory_order_acquire);
  DynamicState& state = *shared;
  state.twists.resize(state_.X_WB.size());
  state.solved.resize(state_.X_WB.size());
  state.loads.resize(state_.X_WB.size());
  state.dof_velocities.resize(state_.dofs.size());
  state.dof_efforts.resize(state_.dofs.size());
  state.joint_velocities.resize(state_.joints.size());
  const size_t known = state.controls.size();
  state.controls.resize(state_.dofs.size());
  for (const auto id : robots()) {
    const Robot& r = robot(id);
    for (size_t i = 0; i < r.dofs.size(); ++i)
      if (const size_t index = r.first_dof + i; index >= known)
        state.controls[index] = first_control(r, i);
  }
  return state;
}

// initial control of a DOF: its motor holds the position, if it has one
DofControl World::first_control(const Robot& r, size_t dof) const {
  return {.mode = r.dofs[dof].driven ? ControlMode::position : ControlMode::effort,
          .target = state_.dofs[r.first_dof + dof],
          .trajectory = {}};
}

DofControl World::control(Id<Robot> id, int dof) const {
  const Robot& r = robot(id);
  const size_t index = r.first_dof + static_cast<size_t>(dof);
  const DynamicState* state = state_.dynamics.get();
  return state && index < state->controls.size() ? state->controls[index]
                                                 : first_control(r, static_cast<size_t>(dof));
}

Twist World::twist(Id<Body> id) const {
  body(id);
  const DynamicState* state = state_.dynamics.get();
  return state && id.index < state->twists.size() ? state->twists[id.index] : Twist{};
}

Twist World::carried_twist(Id<Body> id, Id<Body> carrier) const {
  const Twist of = twist(carrier);
  const Eigen::Vector3d arm = pose(id) * body(id).com - pose(carrier) * body(carrier).com;
  return {of.linear + of.angular.cross(arm), of.angular};
}

// a welded object moves with the body that it is welded to
void World::carry_welded() {
  const auto& welds = dynamic_settings().welds;
  if (welds.empty()) return;
  DynamicState& state = edit_dynamics();
  for (const auto& [object, carrier] : welds) {
    Id<Body> first = carrier;  // the body at the end of a chain of welds
    for (auto next = welds.find(first); next != welds.end(); next = welds.find(first))
      first = next->second;
    state.twists[object.index] = carried_twist(object, first);
  }
}

void World::set_twist(Id<Body> id, const Twist& twist) {
  const Body& b = body(id);
  if (b.kind == BodyKind::link || b.kind == BodyKind::mount)
    fail("body '{}' is a part of robot '{}': set the velocities of its DOFs", excerpt(b.name),
         excerpt(robot(b.robot).name));
  if (b.robot) check_free(b.robot);
  check(velocity_rule.called("linear velocity"), twist.linear, the_body(b.name));
  check(velocity_rule.called("angular velocity"), twist.angular, the_body(b.name));
  edit_dynamics().twists[id.index] = twist;
  if (b.robot) update_link_twists(b.robot);
  carry_welded();
}

Eigen::VectorXd World::dof_velocities(Id<Robot> id) const {
  const Robot& r = robot(id);
  const auto count = static_cast<Eigen::Index>(r.dofs.size());
  const DynamicState* state = state_.dynamics.get();
  if (!state || state->dof_velocities.size() < r.first_dof + r.dofs.size())
    return Eigen::VectorXd::Zero(count);
  return Eigen::Map<const Eigen::VectorXd>(state->dof_velocities.data() + r.first_dof, count);
}

void World::set_dof_velocities(Id<Robot> id, const Eigen::VectorXd& velocities) {
  check_dof_count(id, velocities);
  const Robot& r = robot(id);
  const std::string subject = fmt::format("robot '{}'", excerpt(r.name));
  for (const double v : velocities) check(velocity_rule.called("velocity of a DOF"), v, subject);
  DynamicState& state = edit_dynamics();
  for (int i = 0; i < velocities.size(); ++i) state.dof_velocities[r.first_dof + i] = velocities[i];
  for (size_t j = 0; j < r.joints.size(); ++j)
    if (follows_dof(id, static_cast<int>(j)))
      state.joint_velocities[r.first_joint + j] = r.joints[j].ratio * velocities[r.joints[j].dof];
  update_link_twists(id);
  carry_welded();
}

void World::update_link_twists(Id<Robot> id) {
  const Robot& r = robot(id);
  DynamicState& state = edit_dynamics();
  const RobotFrames all = frames(id);
  const Twist base = state.twists[r.base.index];
  const Eigen::Vector3d p_base = pose(r.base) * body(r.base).com;
  for (size_t l = 0; l < r.links.size(); ++l) {
    const Id<Body> part = r.links[l].body;
    const Eigen::Vector3d com = pose(part) * body(part).com;
    Twist twist{base.linear + base.angular.cross(com - p_base), base.angular};
    for (size_t j = 0; j < r.joints.size(); ++j) {
      if (!joint_moves_link(r, static_cast<int>(j), static_cast<int>(l))) continue;
      const double v = state.joint_velocities[r.first_joint + j];
      twist.linear += v * all.velocity(r, static_cast<int>(j), com);
      if (r.joints[j].kind == JointKind::revolute)
        twist.angular += v * all.axis(r, static_cast<int>(j));
    }
    state.twists[part.index] = twist;
  }
  for (const auto other : robots()) {
    const auto& mounting = robot(other).mounting;
    if (!mounting || mounting->parent != id) continue;
    const Id<Body> carried = robot(other).base;
    state.twists[carried.index] = carried_twist(carried, r.links[mounting->link].body);
    if (mounting->piece)
      state.twists[mounting->piece->index] = carried_twist(*mounting->piece, carried);
    update_link_twists(other);
  }
}

void World::drift(Id<Body> id, const Pose& X_WB) {
  if (!is_place(X_WB)) check_place(X_WB, the_body(body(id).name));
  state_.X_WB[id.index] = X_WB;
}

void World::drift(Id<Robot> id, const Pose& X_WB, std::span<const double> dofs,
                  std::span<const double> joints) {
  const Robot& r = robot(id);
  std::ranges::copy(dofs, state_.dofs.begin() + static_cast<std::ptrdiff_t>(r.first_dof));
  std::ranges::copy(joints, state_.joints.begin() + static_cast<std::ptrdiff_t>(r.first_joint));
  place(id, X_WB);
}

void World::set_follows_dof(Id<Robot> id, int joint, bool follows) {
  state_.follows_dof[robot(id).first_joint + static_cast<size_t>(joint)] = follows;
}

void World::come_to_rest(Id<Body> id) {
  if (!state_.dynamics) return;
  DynamicState& state = edit_dynamics();
  state.twists[id.index] = state.solved[id.index] = {};
  carry_welded();
}

void World::come_to_rest(Id<Robot> id) {
  if (!state_.dynamics) return;
  DynamicState& state = edit_dynamics();
  const Robot& r = robot(id);
  state.twists[r.base.index] =
      r.mounting ? carried_twist(r.base, robot(r.mounting->parent).links[r.mounting->link].body)
                 : Twist{};
  for (size_t i = 0; i < r.dofs.size(); ++i) state.dof_velocities[r.first_dof + i] = 0;
  for (size_t i = 0; i < r.joints.size(); ++i) state.joint_velocities[r.first_joint + i] = 0;
  update_link_twists(id);
  for (const auto part : bodies_of(id)) state.solved[part.index] = state.twists[part.index];
  for (const auto other : robots())
    if (robot(other).mounting && robot(other).mounting->parent == id) come_to_rest(other);
  carry_welded();
}

void World::hold_dofs(Id<Robot> id) {
  if (!state_.dynamics) return;
  DynamicState& state = edit_dynamics();
  const Robot& r = robot(id);
  for (size_t i = r.first_dof; i < r.first_dof + r.dofs.size(); ++i)
    state.controls[i] = {
        .mode = state.controls[i].mode, .target = state_.dofs[i], .trajectory = {}};
}

}  // namespace clench
