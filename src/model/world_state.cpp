// State of a world: poses, DOFs, joints.
#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"
#include "clench/model/world.h"

namespace clench {

void World::set_pose(Id<Body> id, const Pose& X_WB) {
  if (body(id).robot)
    fail("body '{}' is a part of robot '{}': move the robot", excerpt(body(id).name),
         excerpt(robot(body(id).robot).name));
  if (!is_place(X_WB)) check_place(X_WB, the_body(body(id).name));
  state_.X_WB[id.index] = X_WB;
  come_to_rest(id);
}

void World::check_free(Id<Robot> id) const {
  if (robot(id).mounting)
    fail("robot '{}' is carried by '{}': move that one", excerpt(robot(id).name),
         excerpt(robot(robot(id).mounting->parent).name));
}

void World::set_pose(Id<Robot> id, const Pose& X_WB) {
  check_free(id);
  if (!is_place(X_WB)) check_place(X_WB, fmt::format("robot '{}'", excerpt(robot(id).name)));
  place(id, X_WB);
  come_to_rest(id);
}

void World::find_places(Id<Robot> id, const Pose& X_WB) {
  const Robot& r = robot(id);
  auto& places = scratch_.places;
  places.emplace_back(r.base, X_WB);
  if (r.mounting && r.mounting->piece) places.emplace_back(*r.mounting->piece, X_WB);
  const Values q = joints(id);
  find_frames(r, X_WB, {q.data(), r.joints.size()}, scratch_.frames);
  const size_t first = places.size();
  for (size_t l = 0; l < r.links.size(); ++l)
    places.emplace_back(r.links[l].body, scratch_.frames.links[l]);
  for (const auto other : robots()) {
    const auto& mounting = robot(other).mounting;
    if (mounting && mounting->parent == id)
      find_places(other, Pose(places[first + mounting->link].second) * mounting->X_LB);
  }
}

void World::place(Id<Robot> id, const Pose& X_WB) {
  scratch_.places.clear();
  find_places(id, X_WB);
  for (const auto& [part, X] : scratch_.places)
    if (!is_place(X)) check_place(X, the_body(body(part).name));
  for (const auto& [part, X] : scratch_.places) state_.X_WB[part.index] = X;
}

World::Values World::dofs(Id<Robot> id) const {
  const Robot& r = robot(id);
  return {state_.dofs.data() + r.first_dof, static_cast<Eigen::Index>(r.dofs.size())};
}

World::Values World::joints(Id<Robot> id) const {
  const Robot& r = robot(id);
  return {state_.joints.data() + r.first_joint, static_cast<Eigen::Index>(r.joints.size())};
}

bool World::follows_dof(Id<Robot> id, int joint) const {
  return state_.follows_dof[robot(id).first_joint + joint];
}

std::vector<JointPosition> World::own_joint_positions(Id<Robot> id) const {
  const Values q = joints(id);
  std::vector<JointPosition> out(q.size());
  for (int j = 0; j < q.size(); ++j)
    if (!follows_dof(id, j)) out[j] = q[j];
  return out;
}

RobotFrames World::frames(Id<Robot> id) const {
  RobotFrames out;
  const Robot& r = robot(id);
  find_frames(r, pose(r.base), {joints(id).data(), r.joints.size()}, out);
  return out;
}

void World::check_dof_count(Id<Robot> id, const Eigen::VectorXd& q) const {
  if (q.size() != static_cast<Eigen::Index>(robot(id).dofs.size()))
    fail("robot '{}': expected {} DOF values, got {}", excerpt(robot(id).name),
         robot(id).dofs.size(), q.size());
}

void World::set_dofs(Id<Robot> id, const Eigen::VectorXd& q) {
  check_dof_count(id, q);
  const Robot& r = robot(id);
  Eigen::VectorXd inside = q;
  for (int i = 0; i < q.size(); ++i) inside[i] = within_limits(r, i, q[i], "robot");
  // a value set by hand re-engages every joint
  set_joints(id, pose(r.base), inside, {});
}

void World::set_posture(Id<Robot> id, const Pose& X_WB, const Eigen::VectorXd& q) {
  check_free(id);
  check_dof_count(id, q);
  const Robot& r = robot(id);
  if (!is_place(X_WB)) check_place(X_WB, fmt::format("robot '{}'", excerpt(r.name)));
  Eigen::VectorXd inside = q;
  for (int i = 0; i < q.size(); ++i) {
    if (std::isnan(q[i])) within_limits(r, i, q[i], "robot");
    const auto [low, high] = range_around(r, i, q[i]);
    inside[i] = std::clamp(q[i], low, high);
  }
  set_joints(id, X_WB, inside, {});
}

void World::set_dofs_unchecked(Id<Robot> id, const Eigen::VectorXd& q,
                               std::span<const JointPosition> own) {
  set_joints(id, pose(robot(id).base), q, own);
}

void World::set_joints(Id<Robot> id, const Pose& X_WB, const Eigen::VectorXd& q,
                       std::span<const JointPosition> own) {
  const Robot& r = robot(id);
  const auto dofs = state_.dofs.begin() + static_cast<std::ptrdiff_t>(r.first_dof);
  const auto joints = state_.joints.begin() + static_cast<std::ptrdiff_t>(r.first_joint);
  const auto follows = state_.follows_dof.begin() + static_cast<std::ptrdiff_t>(r.first_joint);
  const auto count = static_cast<std::ptrdiff_t>(r.joints.size());
  scratch_.dofs.assign(dofs, dofs + q.size());
  scratch_.joints.assign(joints, joints + count);
  scratch_.follows_dof.assign(follows, follows + count);
  std::copy(q.begin(), q.end(), dofs);
  for (std::ptrdiff_t j = 0; j < count; ++j) {
    const bool has_own = !own.empty() && own[j];
    joints[j] = has_own ? *own[j] : r.joints[j].ratio * q[r.joints[j].dof];
    follows[j] = !has_own;
  }
  try {
    place(id, X_WB);
  } catch (const Error&) {
    std::ranges::copy(scratch_.dofs, dofs);
    std::ranges::copy(scratch_.joints, joints);
    std::ranges::copy(scratch_.follows_dof, follows);
    throw;
  }
  come_to_rest(id);
  hold_dofs(id);
}

}  // namespace clench
