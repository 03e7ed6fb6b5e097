#include "clench/io/urdf_losses.h"

#include <algorithm>

#include "clench/spec/chains.h"

namespace clench {

namespace {

/// Base and links, in their order.
std::vector<const BodySpec*> bodies_of(const RobotSpec& robot) {
  std::vector<const BodySpec*> out = {&robot.base};
  for (const LinkSpec& link : robot.links) out.push_back(&link.body);
  return out;
}

template <class Predicate>
bool any_dof(const RobotSpec& robot, Predicate predicate) {
  return std::ranges::any_of(robot.dofs, predicate);
}

template <class Predicate>
bool any_joint(const RobotSpec& robot, Predicate predicate) {
  return std::ranges::any_of(robot.links, [&](const LinkSpec& link) {
    return std::ranges::any_of(link.joints, predicate);
  });
}

double start_at_zero(const RobotSpec& robot, size_t dof) {
  const auto [low, high] = dof_range(robot, static_cast<int>(dof));
  return std::clamp(0.0, low, high);
}

bool has_default_values(const RobotSpec& robot) {
  for (size_t d = 0; d < robot.dofs.size(); ++d)
    if (const double value = robot.dofs[d].default_value;
        value != 0 && value != start_at_zero(robot, d))
      return true;
  return false;
}

/// Pairs that the formats of GraspIt! do not switch off by themselves.
size_t pairs_off(const RobotSpec& robot) {
  const auto chains = chains_of(robot);
  return std::ranges::count_if(robot.collision_rules.pairs_off, [&](const auto& pair) {
    const auto a = place_of(chains, pair[0]), b = place_of(chains, pair[1]);
    const bool at_base = (a.chain < 0 && b.link == 0) || (b.chain < 0 && a.link == 0);
    return a.chain != b.chain && !at_base;
  });
}

void tell_rules(const RobotSpec& robot, const RobotFolder& folder) {
  const CollisionRules& rules = robot.collision_rules;
  if (const size_t pairs = pairs_off(robot))
    folder.lost(fmt::format("the {} pairs of links that never collide", pairs));
  if (!rules.parts_off.empty())
    folder.lost(fmt::format("the {} parts that never collide", rules.parts_off.size()));
  if (rules.near_pairs_off)
    folder.lost("that parts which are near each other as it is loaded never collide");
}

void tell_sensors(const RobotSpec& robot, const RobotFolder& folder) {
  if (!robot.tactile.empty())
    folder.lost(fmt::format("the {} tactile sensors", robot.tactile.size()));
  if (!robot.tendons.empty() || !robot.wrappers.empty())
    folder.lost(
        fmt::format("the {} tendons and {} wrappers", robot.tendons.size(), robot.wrappers.size()));
  if (!robot.database_name.empty())
    folder.lost("the name in a database of grasps, '" + robot.database_name + "'");
}

void tell_softness(const RobotSpec& robot, const RobotFolder& folder) {
  const BodySpec plain;
  const auto soft = std::ranges::count_if(bodies_of(robot), [&](const BodySpec* body) {
    return body->soft_layer != plain.soft_layer || body->poisson_ratio != plain.poisson_ratio;
  });
  if (soft) folder.lost(fmt::format("the soft layers and Poisson's ratios of {} parts", soft));
}

}  // namespace

static void tell_control(const RobotSpec& robot, const RobotFolder& folder) {
  const auto dof_has = [&](auto predicate, const char* what) {
    if (any_dof(robot, predicate)) folder.lost(what);
  };
  dof_has([](const DofSpec& dof) { return dof.kind != DofKind::rigid; },
          "which DOFs are breakaway or compliant");
  dof_has([](const DofSpec& dof) { return dof.default_velocity != 0; },
          "how fast DOFs close; which do is guessed from the geometry when it is read");
  dof_has([](const DofSpec& dof) { return dof.kp != 0 || dof.kd != 0; }, "the gains of DOFs");
  dof_has([](const DofSpec& dof) { return dof.dragger_scale != 0; },
          "the sizes of the handles of DOFs");
  if (has_default_values(robot)) folder.lost("the default values of DOFs");
  if (any_joint(robot, [](const JointSpec& j) { return j.spring != 0 || j.rest != 0; }))
    folder.lost("the springs of joints");
}

void report_losses(const RobotSpec& robot, const RobotFolder& folder) {
  tell_control(robot, folder);
  std::vector<char> moves(robot.dofs.size());
  each_joint(robot, [&](const JointSpec& joint) { moves[joint.dof] = true; });
  for (size_t d = 0; d < moves.size(); ++d)
    if (!moves[d]) folder.lost(fmt::format("DOF {}, which moves no joint", d));
  const auto bodies = bodies_of(robot);
  const auto body_has = [&](auto predicate, const char* what) {
    if (std::ranges::any_of(bodies, predicate)) folder.lost(what);
  };
  body_has([](const BodySpec* b) { return b->material != "plastic"; },
           "materials; every link counts as plastic when it is read");
  body_has([](const BodySpec* b) { return b->elastic_modulus.has_value(); }, "elastic moduli");
  tell_softness(robot, folder);
  body_has([](const BodySpec* b) { return b->tracker.has_value(); }, "the trackers of links");
  if (robot.X_BA)
    folder.lost("the approach frame; it is guessed from the geometry when it is read");
  if (robot.tracker) folder.lost("the tracker on the robot");
  if (!robot.chain_links_collide)
    folder.lost("that links of one chain never collide with each other");
  tell_rules(robot, folder);
  tell_sensors(robot, folder);
}

}  // namespace clench
