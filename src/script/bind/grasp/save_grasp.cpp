#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/grasp/force/contact_forces.h"
#include "clench/io/mjcf_write/written_keys.h"
#include "clench/io/text/confine.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/grasp/save_grasp.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/bind/world/world_files.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

struct GraspSceneOptions {
  bool is_force_given = false;
  double force = 0;      ///< sum of the normal forces [N]
  double height = 0.1;   ///< height of the lift [m]
  double retreat = 0.1;  ///< distance of a pregrasp that is not known [m]
};

/// The keys "pregrasp", "grasp" and "lift" of a grasp whose hand is at its object.
class GraspKeys {
 public:
  GraspKeys(lua_State* L, const World& world, const Grasp& grasp, const WorldSpec& spec,
            const GraspSceneOptions& options)
      : L_(L), world_(world), grasp_(grasp), spec_(spec), options_(options) {
    const auto& robots = world.robots();
    hand_ = static_cast<int>(std::ranges::find(robots, grasp.hand) - robots.begin());
    for (size_t b = 0; b < spec.bodies.size(); ++b)
      if (spec.bodies[b].body.name == world.body(grasp.object).name) object_ = static_cast<int>(b);
  }

  std::vector<WrittenKey> keys() const {
    WrittenKey grasp = present_key(spec_, "grasp");
    press(grasp);
    WrittenKey lift = grasp;
    lift.name = "lift";
    const Eigen::Vector3d up = upwards() * options_.height;
    lift.robots[hand()].position += up;
    lift.bodies[static_cast<size_t>(object_)].position += up;
    return {pregrasp(grasp), grasp, lift};
  }

 private:
  size_t hand() const { return static_cast<size_t>(hand_); }
  const RobotSpec& robot() const { return spec_.robots[hand()].robot; }
  Eigen::Vector3d upwards() const {
    const Eigen::Vector3d gravity = world_.gravity();
    return gravity.isZero(0) ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(-gravity.normalized());
  }

  /// Efforts or targets of the pressing motors.
  void press(WrittenKey& key) const {
    if (!grasp_.squeeze.empty() && !options_.is_force_given) {
      key.targets.resize(spec_.robots.size());
      key.targets[hand()] = joints_at(robot(), grasp_.squeeze);
      return;
    }
    key.efforts.resize(spec_.robots.size());
    key.efforts[hand()] = efforts();
  }

  // from forces in equilibrium, as large as the motors can exert
  std::vector<double> efforts() const {
    ForceOptions asked;
    asked.objective = ForceObjective::max_margin;
    for (const bool limited : {true, false}) {
      double total = options_.force;
      for (int halvings = 0; halvings < 6; ++halvings, total /= 2) {
        asked.total_force = total;
        asked.joints.emplace().unlimited = !limited;
        const ForceResult found = contact_forces(world_, grasp_, asked);
        if (found.status != ForceStatus::optimal) continue;
        if (halvings > 0)
          log_warning(L_, fmt::format("{}: the motors can press with {:.3g} N in equilibrium, not "
                                      "with {:.3g} N",
                                      subject(L_), total, options_.force));
        return {found.efforts.begin(), found.efforts.end()};
      }
    }
    log_warning(L_, fmt::format("{}: no contact forces are in equilibrium: in the keyframes the "
                                "motors hold the posture and do not press",
                                subject(L_)));
    return {};
  }

  WrittenKey pregrasp(const WrittenKey& grasp) const {
    WrittenKey out = present_key(spec_, "pregrasp");
    const Pose& X_WO = grasp.bodies[static_cast<size_t>(object_)];
    if (grasp_.pregrasp) {
      out.robots[hand()] = X_WO * grasp_.pregrasp->X_OH;
      out.joints[hand()] = joints_at(robot(), grasp_.pregrasp->dofs);
      return out;
    }
    const Pose X_WA = out.robots[hand()] * robot().X_BA.value_or(Pose{});
    out.robots[hand()].position -= options_.retreat * (X_WA.rotation * Eigen::Vector3d::UnitZ());
    out.joints[hand()] = joints_at(robot(), open_dofs());
    log_warning(L_, fmt::format("{}: the grasp has no pregrasp: in the key 'pregrasp' the hand is "
                                "open, {} m back along its direction of approach",
                                subject(L_), options_.retreat));
    return out;
  }

  // closing DOFs at the ends of their ranges that open the hand
  std::vector<double> open_dofs() const {
    std::vector<double> out = spec_.robots[hand()].dofs;
    for (size_t d = 0; d < out.size(); ++d) {
      const double closing = robot().dofs[d].default_velocity;
      const int dof = static_cast<int>(d);
      if (closing == 0 || dof_is_endless(robot(), dof)) continue;
      const auto range = dof_range(robot(), dof);
      out[d] = range[closing > 0 ? 0 : 1];
    }
    return out;
  }

  lua_State* L_;
  const World& world_;
  const Grasp& grasp_;
  const WorldSpec& spec_;
  const GraspSceneOptions& options_;
  int hand_ = 0, object_ = 0;
};

GraspSceneOptions read_grasp_scene(Table& options, const World& world, Id<Body> object) {
  const double gravity = world.gravity().isZero(0) ? standard_gravity : world.gravity().norm();
  GraspSceneOptions out;
  out.is_force_given = options.has("force");
  out.force =
      out.is_force_given ? options.number("force") : 10 * gravity * world.body(object).mass;
  out.height = options.number("height", out.height);
  return out;
}

// mean of the radii of the soft contacts; 0 without any
double torsion_radius_of(const Grasp& grasp) {
  double sum = 0;
  int count = 0;
  for (const PointContact& point : grasp.points)
    if (point.torsion_radius > 0) sum += point.torsion_radius, ++count;
  return count > 0 ? sum / count : 0;
}

}  // namespace

int save_grasp(lua_State* L) {
  const auto& handle = self<GraspHandle>(L);
  world_of(L, handle);
  const fs::path path = check_output(L, 2);
  const std::string ending = lower_case(path.extension().string());
  if (ending != ".xml" && ending != ".mjcf")
    fail("{}: expected a scene of MuJoCo to .xml or .mjcf, got {}", path.filename().string(),
         in_quotes(ending));
  Table options(L, 3);
  const GraspSceneOptions scene = read_grasp_scene(options, *handle.world, handle.grasp.object);
  const SavingOptions saving{.root = {}, .confine = read_confine(L, options), .format = "mjcf"};
  options.done();
  check_target(path, saving.confine);
  World world = *handle.world;
  // the posture of the grasp, even if the robot has moved since
  if (!stands_as_grasped(world, handle.grasp, handle.grasp.hand, handle.grasp.object))
    apply_grasp(world, handle.grasp, handle.grasp.hand, handle.grasp.object);
  Grasp grasp = find_grasp(world, handle.grasp.hand, handle.grasp.object, handle.grasp.options);
  grasp.pregrasp = handle.grasp.pregrasp;
  grasp.squeeze = handle.grasp.squeeze;
  const WorldSpec spec = scene_spec(world);
  SceneRequest request = scene_of(world, spec, path);
  request.torsion_radius = torsion_radius_of(grasp);
  request.keys = GraspKeys(L, world, grasp, spec, scene).keys();
  if (!world.robot(grasp.hand).mounting) {
    const auto& robots = world.robots();
    request.carriage = static_cast<int>(std::ranges::find(robots, grasp.hand) - robots.begin());
  } else {
    // these keys would require motions of the arm
    request.keys = {request.keys[1]};
    log_warning(L, fmt::format("{}: '{}' is carried by a robot: the scene has the key 'grasp', and "
                               "no 'pregrasp' and 'lift'",
                               subject(L), world.robot(grasp.hand).name));
  }
  save_scene(L, world, path, saving, request);
  return 0;
}

}  // namespace clench
