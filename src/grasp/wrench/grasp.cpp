#include "clench/grasp/wrench/grasp.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/grasp/wrench/max_space_edges.h"
#include "clench/model/dof.h"

namespace clench {

// contacts that share a site have one patch
static void add_torsion(Grasp& grasp, const GraspOptions& options) {
  std::map<const SoftSite*, SoftPatch> known;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    const SoftSite* const site = grasp.contacts[i].site.get();
    if (!site) continue;
    const auto [found, is_new] = known.try_emplace(site);
    SoftPatch& patch = found->second;
    if (is_new) patch = soft_patch(*site);
    grasp.points[i].torsion_radius =
        torsion_radius(patch, options.normal_force.of(static_cast<int>(i)), options.modulus);
    grasp.contacts_at_edges += patch.at_edge;
  }
}

static Pose hand_in_object(const World& world, Id<Robot> hand, Id<Body> object) {
  return world.pose(object).inverse() * world.pose(world.robot(hand).base);
}

// of metres and radians: a hundredth of the usual contact threshold, far above rounding
static constexpr double moved = 1e-6;

static bool has_moved(const Pose& off) {
  return off.position.norm() > moved || off.angle() > moved;
}

bool stands_as_grasped(const World& world, const GraspSpec& grasp, Id<Robot> hand,
                       Id<Body> object) {
  return grasp.X_OH && !has_moved(grasp.X_OH->inverse() * hand_in_object(world, hand, object));
}

void check_unmoved(const World& world, const Grasp& grasp) {
  if (!grasp.X_OH) return;
  const bool object =
      has_moved(grasp.X_OH->inverse() * hand_in_object(world, grasp.hand, grasp.object));
  const bool joints =
      !std::ranges::equal(grasp.joints, world.joints(grasp.hand),
                          [](double a, double b) { return std::abs(a - b) <= moved; });
  const bool friction = std::ranges::any_of(grasp.contacts, [&](const Contact& c) {
    const Friction f =
        world.materials().friction(world.body(c.body).material, world.body(c.other).material);
    return f.statics != c.friction.statics;
  });
  const bool com = (grasp.com - world.body(grasp.object).com).norm() > moved;
  if (object || joints || friction || com)
    fail(ErrorKind::stale, "grasp of {} by {}: {} since it was measured; measure it anew",
         world.body(grasp.object).name, world.robot(grasp.hand).name,
         friction ? "friction has changed"
         : com    ? "the object's centre of mass has changed"
         : joints ? "joints of the hand have moved"
                  : "hand and object have moved apart");
}

Grasp measure_grasp(const World& world, Id<Robot> hand, Id<Body> object,
                    const GraspOptions& options) {
  const Body& held = world.body(object);
  const std::string& hand_name = world.robot(hand).name;
  const auto refuse = [&](const std::string& why) {
    fail("grasp of {} by {}: {}", held.name, hand_name, why);
  };
  if (held.robot)
    refuse(fmt::format("{} is a part of {}", held.name, world.robot(held.robot).name));
  if ((options.edges < 3 || options.edges > max_edges) && options.edges != round_edges)
    refuse(fmt::format("edges must be 3 to {}, got {}", max_edges, options.edges));
  if (options.rho && !(std::isfinite(*options.rho) && *options.rho > 0))
    refuse(fmt::format("rho must be > 0 [m], got {}", *options.rho));
  // of many contacts some may carry nothing
  const auto& forces = options.normal_force.values;
  for (const double force : forces)
    if (!(std::isfinite(force) && (force > 0 || (force == 0 && forces.size() > 1))))
      refuse(fmt::format("the normal force must be > 0 [N], got {}", force));

  Grasp grasp;
  grasp.hand = hand;
  grasp.object = object;
  grasp.hand_name = hand_name;
  grasp.object_name = held.name;
  grasp.hand_file = world.robot(hand).source;
  grasp.object_file = held.source;
  grasp.X_OH = hand_in_object(world, hand, object);
  const auto dofs = world.dofs(hand), joints = world.joints(hand);
  grasp.dofs.assign(dofs.begin(), dofs.end());
  grasp.joints.assign(joints.begin(), joints.end());
  const Robot& robot = world.robot(hand);
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
    grasp.dof_names.push_back(dof_name(robot, d));
    grasp.dof_units.push_back(dof_slides(robot, d) ? "m" : "rad");
  }
  grasp.com = held.com;
  grasp.options = options;
  // a body without extent has no contacts either: any length will do
  const double radius = held.max_radius();
  const double gyration = std::sqrt(std::max(0.0, held.inertia_per_mass.trace() / 2));
  grasp.largest_radius = radius > 0 ? radius : 1;
  grasp.gyration_radius = gyration > 0 ? gyration : 1;
  grasp.rho = options.rho.value_or(grasp.length(options.length));

  const auto parts = world.bodies_of(hand);
  grasp.contacts = contacts(world, parts, std::span(&object, 1));
  const Pose X_OW = world.pose(object).inverse();
  for (const Contact& contact : grasp.contacts) {
    grasp.links.push_back(world.body(contact.other).name);
    grasp.points.push_back({.p_O = X_OW * contact.p_W,
                            .n_O = (X_OW.rotation * contact.n_W).normalized(),
                            .mu = contact.friction.statics});
  }
  if (forces.empty() || !options.normal_force.fits(grasp.contacts.size()))
    refuse(fmt::format("normal_force: expected one number or {}, one per contact, got {}",
                       grasp.contacts.size(), forces.size()));
  if (options.soft) add_torsion(grasp, options);
  return grasp;
}

// values of all DOFs of a hand: those of the grasp, by their names where it has them, the others as
// they are
static Eigen::VectorXd dofs_for(const World& world, Id<Robot> hand, const GraspSpec& grasp,
                                const std::string& place) {
  const Robot& robot = world.robot(hand);
  Eigen::VectorXd q = world.dofs(hand);
  std::vector<std::string> names;
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) names.push_back(dof_name(robot, d));
  for (size_t i = 0; i < grasp.dofs.size(); ++i) {
    size_t d = i;
    if (!grasp.dof_names.empty()) {
      d = static_cast<size_t>(std::ranges::find(names, grasp.dof_names[i]) - names.begin());
      if (d == names.size())
        fail("{}: the hand has no DOF {}{}", place, in_quotes(grasp.dof_names[i]),
             instead_of(grasp.dof_names[i], names));
    }
    const std::string unit = i < grasp.dof_units.size() ? grasp.dof_units[i] : "",
                      own =
                          d < names.size() && dof_slides(robot, static_cast<int>(d)) ? "m" : "rad";
    if ((unit == "rad" || unit == "m") && unit != own)
      fail("{}: DOF {}: expected a value in {}, got one in {}", place, in_quotes(names[d]), own,
           unit);
    q[static_cast<Eigen::Index>(d)] = grasp.dofs[i];
  }
  return q;
}

// joints of rigid DOFs have no positions of their own
static void check_rigid_joints(const Robot& robot, const Eigen::VectorXd& q,
                               const std::vector<double>& joints, const std::string& place) {
  // of metres and radians: far above the rounding of a file
  constexpr double apart = 1e-6;
  for (size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    const double by_dof = joint.ratio * q[joint.dof];
    if (robot.dofs[joint.dof].kind == DofKind::rigid && !(std::abs(joints[j] - by_dof) <= apart))
      fail(
          "{}: joint {} stands at {}, and its DOF puts it at {}; without 'joints' the DOFs tell "
          "all",
          place, j + 1, joints[j], by_dof);
  }
}

void apply_grasp(World& world, const GraspSpec& grasp) {
  const auto hand = world.find_robot(grasp.hand_name);
  const auto object = world.find_body(grasp.object_name);
  const auto missing = [&](const std::string& name, const char* what) {
    if (name.empty())
      fail("grasp of {} by {}: it does not name its {}; one has to be given",
           in_quotes(grasp.object_name), in_quotes(grasp.hand_name), what);
    fail("grasp of {} by {}: there is no such {} in this world", grasp.object_name, grasp.hand_name,
         what);
  };
  if (!hand) missing(grasp.hand_name, "hand");
  if (!object) missing(grasp.object_name, "object");
  apply_grasp(world, grasp, hand, object);
}

void apply_grasp(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object) {
  const Robot& robot = world.robot(hand);
  const std::string place = fmt::format("grasp of {} by {}", world.body(object).name, robot.name);
  if (!grasp.X_OH) fail("{}: it was put together by hand and says not how the hand stands", place);
  // what names its DOFs may name some of them; what knows no joints leaves them to the DOFs
  const bool own_joints = !grasp.joints.empty();
  const bool whole = own_joints || (grasp.dof_names.empty() && !grasp.dofs.empty());
  if ((whole && grasp.dofs.size() != robot.dofs.size()) ||
      (own_joints && grasp.joints.size() != robot.joints.size()))
    fail("{}: it has {} DOFs and {} joints, the hand {} and {}", place, grasp.dofs.size(),
         grasp.joints.size(), robot.dofs.size(), robot.joints.size());
  const Eigen::VectorXd q = dofs_for(world, hand, grasp, place);
  if (own_joints) check_rigid_joints(robot, q, grasp.joints, place);
  const Pose before = world.pose(robot.base);
  if (robot.mounting) {
    const Pose off = grasp.X_OH->inverse() * hand_in_object(world, hand, object);
    if (has_moved(off))
      fail(
          "{}: robot '{}' carries the hand, {:.3g} m and {:.3g} rad from where it stood about the "
          "object: move that one",
          place, world.robot(robot.mounting->parent).name, off.position.norm(), off.angle());
  } else {
    world.set_pose(hand, world.pose(object) * *grasp.X_OH);
  }
  try {
    world.set_dofs(hand, q);
  } catch (const Error&) {
    if (!robot.mounting) world.set_pose(hand, before);
    throw;
  }
  if (!own_joints) return;
  std::vector<JointPosition> own(grasp.joints.size());
  for (size_t j = 0; j < own.size(); ++j)
    if (grasp.joints[j] != world.joints(hand)[static_cast<Eigen::Index>(j)])
      own[j] = grasp.joints[j];
  world.set_dofs_unchecked(hand, q, own);
}

WrenchSpace wrench_space(const GraspSpec& grasp, const GraspSpaceOptions& options) {
  const ConeOptions cone{.edges = options.edges.value_or(grasp.options.edges),
                         .rho = options.rho.value_or(grasp.rho),
                         .p_OM = grasp.com};
  std::vector<UnitWrenches> contacts;
  Eigen::Index edges = 0;
  for (const PointContact& point : grasp.points) {
    check_stop();
    edges += contacts.emplace_back(unit_wrenches(point, cone)).edges.cols();
    if (edges > max_space_edges)
      fail(ErrorKind::limit,
           "wrench space: expected at most {} edges of all contacts, got more of {} contacts of {} "
           "edges; give fewer edges, or edges = \"exact\"",
           max_space_edges, grasp.points.size(), cone.edges);
  }
  return WrenchSpace(std::move(contacts), options.space);
}

const WrenchSpacePtr& space_of(const Grasp& grasp, const GraspSpaceOptions& options) {
  return grasp.spaces.get(options, [&] { return wrench_space(grasp, options); });
}

}  // namespace clench
