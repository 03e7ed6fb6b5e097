#include "clench/script/bind/grasp/apply_grasp.h"

#include "clench/grasp/wrench/grasp_identity.h"
#include "clench/planning/apply_by_arm.h"
#include "clench/script/bind/grasp/dof_order.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

void note_identity(lua_State* L, const World& world, Grasp& grasp) {
  identify(world, grasp, kept<ShapeFingerprints>(L));
  grasp.engine_version = CLENCH_VERSION;
}

static Place place_of(const GraspSpec& grasp) {
  return Place("", 0, fmt::format("grasp of {} by {}", grasp.object_name, grasp.hand_name));
}

static GraspDofOptions dof_options(lua_State* L, DofOrder order) {
  return {.order = order, .diagnostics = log_losses(L)};
}

// in the order of the hand's DOFs; apply itself warns of values that differ from the file's
static std::optional<PregraspState> pregrasp_of(const World& world, Id<Robot> hand,
                                                const GraspSpec& grasp, DofOrder order) {
  if (!grasp.pregrasp) return {};
  const GraspDofOptions quiet{.order = order};
  const auto q =
      pregrasp_dofs(world, hand, grasp, grasp_posture(world, hand, grasp, place_of(grasp), quiet),
                    place_of(grasp), quiet);
  return PregraspState{grasp.pregrasp->X_OH, {q.begin(), q.end()}};
}

// once, because lists have thousands
static void warn_of_others(lua_State* L, const World& world, const GraspSpec& grasp, Id<Robot> hand,
                           Id<Body> object) {
  static const char of_identity = 0;
  const std::string text =
      identity_difference(world, grasp, hand, object, kept<ShapeFingerprints>(L));
  if (!text.empty() && first_time(L, &of_identity, text)) log_warning(L, text);
}

// sets the hand to the grasp, and measures it there
int apply_by_script(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  if (!given(L, 2)) world_of(L, g);
  const WorldPtr world = given(L, 2) ? check_object<WorldHandle>(L, 2, "world").world : g.world;
  Table options(L, 3);
  const auto in_world = [&](const WorldPtr& other, const char* key) {
    if (other != world)
      fail("{}: {}: expected one of that world, got one of another", subject(L), key);
  };
  const auto* given_hand = options.object<RobotHandle>("hand");
  if (given_hand) in_world(given_hand->world, "hand");
  const auto* given_object = options.object<BodyHandle>("object");
  if (given_object) in_world(given_object->world, "object");
  const NamedOrder order = read_dof_order(options);
  options.done();
  GraspSpec named = g.grasp;
  if (given_hand) named.hand_name = (*given_hand)->name;
  if (given_object) named.object_name = (*given_object)->name;
  const auto hand = given_hand ? given_hand->id : world->find_robot(named.hand_name);
  const auto object = given_object ? given_object->id : world->find_body(named.object_name);
  if (!hand || !object) apply_grasp(*world, named);  // the error names what is missing
  if (named.dof_names.empty() && !order.names.empty()) name_dofs(named, order, nullptr, subject(L));
  warn_of_others(L, *world, g.grasp, hand, object);
  const GraspDofOptions dofs = dof_options(L, order.order);
  const auto before = pregrasp_of(*world, hand, named, dofs.order);
  apply_by_arm(*world, named, hand, object, dofs);
  Grasp measured = find_grasp(*world, hand, object, g.grasp.options);
  note_identity(L, *world, measured);
  measured.info = g.grasp.info;
  measured.labels = g.grasp.labels;
  measured.pregrasp = before;
  // values of DOFs in another order would apply to other motors
  if (named.dof_names == measured.dof_names) measured.squeeze = g.grasp.squeeze;
  return push_object(L, GraspHandle{world, std::move(measured)});
}

// the DOFs that apply would set, and those of the pregrasp
int grasp_dofs_for(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  const auto& hand = check_object<RobotHandle>(L, 2, "hand");
  Table options(L, 3);
  const NamedOrder order = read_dof_order(options);
  options.done();
  GraspSpec named = g.grasp;
  if (named.dof_names.empty() && !order.names.empty()) name_dofs(named, order, nullptr, subject(L));
  const GraspDofOptions dofs = dof_options(L, order.order);
  const auto posture = grasp_posture(*hand.world, hand.id, named, place_of(named), dofs);
  push(L, posture.dofs);
  if (!named.pregrasp) return 1;
  push(L, pregrasp_dofs(*hand.world, hand.id, named, posture, place_of(named), dofs));
  return 2;
}

}  // namespace clench
