#include "clench/grasp/wrench/grasp.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/grasp/wrench/grasp_dofs.h"
#include "clench/grasp/wrench/max_space_edges.h"
#include "clench/model/dof.h"

namespace clench {

namespace {

// The patch of a site, and its torsion radius under the normal force of the last contact.
struct Torsion {
  SoftPatch patch;
  double force = -1, radius = 0;  // [N], [m]
};

}  // namespace

// Contacts that share a site have one patch, and under the same force one torsion radius.
static void add_torsion(Grasp& grasp, const GraspOptions& options) {
  std::map<const SoftSite*, Torsion> known;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    const SoftSite* const site = grasp.contacts[i].site.get();
    if (!site) continue;
    const auto [found, is_new] = known.try_emplace(site);
    Torsion& torsion = found->second;
    if (is_new) torsion.patch = soft_patch(*site);
    const double force = options.normal_force.of(static_cast<int>(i));
    if (is_new || force != torsion.force)
      torsion.force = force, torsion.radius = torsion_radius(torsion.patch, force, options.modulus);
    grasp.points[i].torsion_radius = torsion.radius;
    grasp.contacts_at_edges += torsion.patch.at_edge;
  }
}

static Pose hand_in_object(const World& world, Id<Robot> hand, Id<Body> object) {
  return world.pose(object).inverse() * world.pose(world.robot(hand).base);
}

// of meters and radians: a hundredth of the usual contact threshold, far above rounding
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
         : com    ? "the object's center of mass has changed"
         : joints ? "joints of the hand have moved"
                  : "hand and object have moved apart");
}

// raises an error about a grasp that cannot be measured
template <class... Args>
[[noreturn]] static void refuse(const World& world, Id<Robot> hand, Id<Body> object,
                                fmt::format_string<Args...> format, Args&&... args) {
  fail("grasp of {} by {}: {}", world.body(object).name, world.robot(hand).name,
       fmt::format(format, std::forward<Args>(args)...));
}

static void check_options(const World& world, Id<Robot> hand, Id<Body> object,
                          const GraspOptions& options) {
  const Body& held = world.body(object);
  if (held.robot)
    refuse(world, hand, object, "{} is a part of {}", held.name, world.robot(held.robot).name);
  if ((options.edges < 3 || options.edges > max_edges) && options.edges != round_edges)
    refuse(world, hand, object, "edges must be 3 to {}, got {}", max_edges, options.edges);
  if (options.rho && !(std::isfinite(*options.rho) && *options.rho > 0))
    refuse(world, hand, object, "rho must be > 0 [m], got {}", *options.rho);
  // with many contacts some may carry nothing
  const auto& forces = options.normal_force.values;
  for (const double force : forces)
    if (!(std::isfinite(force) && (force > 0 || (force == 0 && forces.size() > 1))))
      refuse(world, hand, object, "the normal force must be > 0 [N], got {}", force);
}

// pose, DOFs and joints of the hand, with their names and units
static void add_posture(const World& world, Grasp& grasp) {
  const Robot& robot = world.robot(grasp.hand);
  grasp.X_OH = hand_in_object(world, grasp.hand, grasp.object);
  const auto dofs = world.dofs(grasp.hand), joints = world.joints(grasp.hand);
  grasp.dofs.assign(dofs.begin(), dofs.end());
  grasp.joints.assign(joints.begin(), joints.end());
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
    grasp.dof_names.push_back(dof_name(robot, d));
    grasp.dof_units.push_back(dof_slides(robot, d) ? "m" : "rad");
  }
  grasp.joint_names = joint_names(robot);
  for (const Joint& joint : robot.joints) {
    grasp.joint_units.emplace_back(joint.kind == JointKind::prismatic ? "m" : "rad");
    if (joint.offset != 0) grasp.joint_offsets.resize(robot.joints.size());
  }
  for (size_t j = 0; j < grasp.joint_offsets.size(); ++j)
    grasp.joint_offsets[j] = robot.joints[j].offset;
}

static void add_contacts(const World& world, Grasp& grasp) {
  const auto parts = world.bodies_of(grasp.hand);
  grasp.contacts = contacts(world, parts, std::span(&grasp.object, 1));
  const Pose X_OW = world.pose(grasp.object).inverse();
  for (const Contact& contact : grasp.contacts) {
    grasp.links.push_back(world.body(contact.other).name);
    grasp.points.push_back({.p_O = X_OW * contact.p_W,
                            .n_O = (X_OW.rotation * contact.n_W).normalized(),
                            .mu = contact.friction.statics});
  }
}

Grasp find_grasp(const World& world, Id<Robot> hand, Id<Body> object, const GraspOptions& options) {
  check_options(world, hand, object, options);
  const Body& held = world.body(object);
  const Robot& robot = world.robot(hand);
  Grasp grasp;
  grasp.hand = hand;
  grasp.object = object;
  grasp.hand_name = robot.name;
  grasp.object_name = held.name;
  grasp.hand_file = robot.source;
  grasp.object_file = held.source;
  add_posture(world, grasp);
  grasp.com = held.com;
  grasp.options = options;
  // a body without extent has no contacts either: any length is valid
  const double radius = held.max_radius();
  const double gyration = std::sqrt(std::max(0.0, held.inertia_per_mass.trace() / 2));
  grasp.largest_radius = radius > 0 ? radius : 1;
  grasp.gyration_radius = gyration > 0 ? gyration : 1;
  grasp.rho = options.rho.value_or(grasp.length(options.length));
  add_contacts(world, grasp);
  const auto& forces = options.normal_force.values;
  if (forces.empty() || !options.normal_force.fits(grasp.contacts.size()))
    refuse(world, hand, object, "normal_force: expected one number or {}, one per contact, got {}",
           grasp.contacts.size(), forces.size());
  if (options.soft) add_torsion(grasp, options);
  return grasp;
}

void apply_grasp(World& world, const GraspSpec& grasp) {
  const auto hand = world.find_robot(grasp.hand_name);
  const auto object = world.find_body(grasp.object_name);
  const auto missing = [&](const std::string& name, const char* what) {
    if (name.empty())
      fail("grasp of {} by {}: it does not name its {}; give one", in_quotes(grasp.object_name),
           in_quotes(grasp.hand_name), what);
    fail("grasp of {} by {}: there is no such {} in this world", grasp.object_name, grasp.hand_name,
         what);
  };
  if (!hand) missing(grasp.hand_name, "hand");
  if (!object) missing(grasp.object_name, "object");
  apply_grasp(world, grasp, hand, object);
}

void apply_grasp(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object) {
  apply_grasp(world, grasp, hand, object, {});
}

void apply_grasp(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object,
                 const GraspDofOptions& options) {
  const Robot& robot = world.robot(hand);
  const Place place("", 0, fmt::format("grasp of {} by {}", world.body(object).name, robot.name));
  if (!grasp.X_OH) fail("{}: it contains no pose of the hand", place);
  const GraspPosture posture = grasp_posture(world, hand, grasp, place, options);
  const Pose before = world.pose(robot.base);
  if (robot.mounting) {
    const Pose off = grasp.X_OH->inverse() * hand_in_object(world, hand, object);
    if (has_moved(off))
      fail(
          "{}: robot '{}' carries the hand, {:.3g} m and {:.3g} rad from its pose in the grasp: "
          "move that robot",
          place, world.robot(robot.mounting->parent).name, off.position.norm(), off.angle());
  } else {
    world.set_pose(hand, world.pose(object) * *grasp.X_OH);
  }
  try {
    world.set_dofs(hand, posture.dofs);
  } catch (const Error&) {
    if (!robot.mounting) world.set_pose(hand, before);
    throw;
  }
  if (posture.own.empty()) return;
  // joints at the positions given by their DOF follow it
  std::vector<JointPosition> own = posture.own;
  for (size_t j = 0; j < own.size(); ++j)
    if (own[j] && *own[j] == world.joints(hand)[static_cast<Eigen::Index>(j)]) own[j].reset();
  world.set_dofs_unchecked(hand, posture.dofs, own);
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
