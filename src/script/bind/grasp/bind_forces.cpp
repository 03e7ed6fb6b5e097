#include "clench/grasp/force/equilibrium.h"
#include "clench/grasp/force/preload.h"
#include "clench/grasp/force/torque_fit.h"
#include "clench/model/dof.h"
#include "clench/model/effort_range.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

// --- options ---

static std::optional<double> number_if(Table& options, const char* key) {
  if (!options.has(key)) return {};
  return options.number(key);
}

// torque_limits: true, false, or a number for each DOF
static bool read_limits(Table& options, bool fallback, JointDemand& joints) {
  if (!options.has("torque_limits")) return fallback;
  const int type = options.type("torque_limits");
  if (type == LUA_TBOOLEAN) return options.boolean("torque_limits", fallback);
  if (type != LUA_TTABLE) {
    options.push("torque_limits");
    fail_expected(options.what("torque_limits"), "true or a list of numbers", -1);
  }
  joints.limits = options.vector("torque_limits");
  return true;
}

static void read_caps(Table& options, ForceOptions& forces) {
  forces.max_force = read_per_contact(options, "max_force");
  forces.max_total_force = number_if(options, "max_total_force");
  forces.total_force = number_if(options, "total_force");
}

// limits and totals of joints; forces.joints stays empty if they are not requested
static void read_joints(Table& options, ForceOptions& forces) {
  JointDemand joints;
  bool asked = read_limits(options, false, joints);
  joints.unlimited = !asked;
  joints.total_torque = number_if(options, "total_torque");
  joints.unilateral = options.boolean("unilateral", false);
  joints.arms = options.boolean("arms", false);
  joints.link_weights = options.boolean("link_weights", false);
  asked = asked || joints.total_torque || joints.unilateral || joints.arms || joints.link_weights;
  if (asked) forces.joints = joints;
}

static ForceObjective read_objective(Table& options) {
  return options.choice("objective",
                        {{"min_sum", ForceObjective::min_sum},
                         {"min_norm", ForceObjective::min_norm},
                         {"min_max", ForceObjective::min_max},
                         {"max_margin", ForceObjective::max_margin},
                         {"max_margin_sum", ForceObjective::max_margin_sum}},
                        ForceObjective::min_sum);
}

// --- results ---

static const char* status_name(ForceStatus status) {
  return word_of(status, {{"optimal", ForceStatus::optimal},
                          {"infeasible", ForceStatus::infeasible},
                          {"unbounded", ForceStatus::unbounded},
                          {"inaccurate", ForceStatus::inaccurate}});
}

static const char* status_name(EquilibriumStatus status) {
  return word_of(status, {{"stable", EquilibriumStatus::stable},
                          {"unstable", EquilibriumStatus::unstable},
                          {"moving", EquilibriumStatus::moving},
                          {"inaccurate", EquilibriumStatus::inaccurate}});
}

static void push_force(lua_State* L, const GraspHandle& g, const ContactForce& f, size_t i) {
  push_record(L, {{"contact", ContactHandle{g.world, g.grasp.contacts[i]}},
                  {"normal", f.normal},
                  {"tangential", f.tangential},
                  {"torsion", f.torsion},
                  {"mu", g.grasp.points[i].mu},
                  {"force", f.force_W},
                  {"margin", f.margin}});
}

static void push_certificate(lua_State* L, const GraspHandle& g, const ForceCertificate& c) {
  push_record(L, {{"twist", c.twist},
                  {"power", c.power},
                  {"capacity", c.capacity},
                  {"separation_rates", c.separation_rates},
                  {"sliding_rates", c.sliding_rates},
                  {"force_limit_power", c.force_limit_power},
                  {"effort_limit_power", c.effort_limit_power}});
  if (c.dof >= 0) set_field(L, "dof", c.dof + 1);
  if (c.contact >= 0) set_field(L, "contact", ContactHandle{g.world, g.grasp.contacts[c.contact]});
}

// pushes the result
static void push_result(lua_State* L, const GraspHandle& g, const ForceResult& r,
                        const char* status) {
  push_record(L, {{"status", status}});
  if (r.status == ForceStatus::optimal || r.status == ForceStatus::inaccurate) {
    const auto push_forces = [&] {
      size_t i = 0;
      push_list_of(L, r.forces, [&](const ContactForce& f) { push_force(L, g, f, i++); });
    };
    set_fields(L, {{"forces", push_forces},
                   {"unbalanced", r.unbalanced},
                   {"residual", r.residual},
                   {"margin", r.margin},
                   {"joint_torques", r.efforts}});
  }
  if (r.certificate) set_field(L, "certificate", [&] { push_certificate(L, g, *r.certificate); });
}

// names of the motors whose limits matter here but are unknown
static void push_unlimited(lua_State* L, const GraspHandle& g,
                           const std::optional<JointDemand>& joints) {
  if (!joints || joints->unlimited || joints->limits || joints->efforts || joints->springs_only)
    return;
  const World& world = world_of(L, g);
  std::vector<std::string> names;
  for (const int dof : unlimited_dofs(world, g.grasp.hand))
    names.push_back(dof_name(world.robot(g.grasp.hand), dof));
  if (!names.empty()) set_field(L, "unlimited_efforts", names);
}

// --- methods ---

static int forces(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  Table options(L, 2);
  ForceOptions asked;
  if (options.has("load")) asked.load = options.vector("load", 6);
  read_caps(options, asked);
  read_joints(options, asked);
  asked.objective = read_objective(options);
  asked.nearest = options.choice("balance", {{"exact", false}, {"nearest", true}}, false);
  options.done();
  const ForceResult r = contact_forces(world_of(L, g), g.grasp, asked);
  push_result(L, g, r, status_name(r.status));
  push_unlimited(L, g, asked.joints);
  if (!asked.nearest && r.status == ForceStatus::optimal) set_field(L, "objective", r.objective);
  return 1;
}

static int largest(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  Table options(L, 2);
  ForceOptions asked;
  asked.load = options.vector("direction", 6);
  read_caps(options, asked);
  read_joints(options, asked);
  if (options.has("torques")) {
    if (!asked.joints) asked.joints.emplace();
    asked.joints->efforts = options.vector("torques");
  }
  options.done();
  const ForceResult r = max_load(world_of(L, g), g.grasp, asked);
  push_result(L, g, r, r.status == ForceStatus::unbounded ? "unlimited" : status_name(r.status));
  push_unlimited(L, g, asked.joints);
  if (r.status == ForceStatus::optimal) set_field(L, "load", r.load_factor);
  return 1;
}

static int balance(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  Table options(L, 2);
  EquilibriumOptions asked;
  if (options.has("load")) asked.load = options.vector("load", 6);
  asked.max_force = read_per_contact(options, "max_force");
  asked.joints.unlimited = !read_limits(options, true, asked.joints);
  asked.joints.arms = options.boolean("arms", false);
  asked.joints.link_weights = options.boolean("link_weights", false);
  if (options.type("torques") == LUA_TSTRING)
    asked.joints.springs_only =
        options.choice("torques", {{"springs", true}, {"limits", false}}, false);
  else if (options.has("torques"))
    asked.joints.efforts = options.vector("torques");
  options.done();
  const Equilibrium e = equilibrium(world_of(L, g), g.grasp, asked);
  push_result(L, g, e.result, status_name(e.status));
  push_unlimited(L, g, asked.joints);
  return 1;
}

static const char* preload_status(ConeStatus status) {
  if (status == ConeStatus::optimal) return "optimal";
  return status == ConeStatus::infeasible ? "infeasible" : "inaccurate";
}

static int preload(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  Table options(L, 2);
  PreloadOptions asked;
  for (const auto& load : options.rows("loads", 6))
    asked.loads.push_back(Vector6d::Map(load.data()));
  asked.locked = options.boolean("locked", false);
  asked.max_force = read_per_contact(options, "max_force");
  asked.joints.unlimited = !read_limits(options, true, asked.joints);
  asked.joints.unilateral = options.boolean("unilateral", false);
  asked.joints.arms = options.boolean("arms", false);
  asked.joints.link_weights = options.boolean("link_weights", false);
  options.done();
  const Preload r = optimal_preload(world_of(L, g), g.grasp, asked);
  push_record(L, {{"status", preload_status(r.status)}});
  if (!r.normals.empty())
    set_fields(L, {{"torques", r.efforts}, {"fraction", r.fraction}, {"normals", r.normals}});
  push_unlimited(L, g, asked.joints);
  return 1;
}

// base, columns and ranges; each row of `columns` is a parameter
static TorqueFamily read_family(Table& options) {
  TorqueFamily family;
  family.base = options.vector("base");
  const auto columns = options.rows("columns", static_cast<int>(family.base.size()));
  const auto ranges = options.rows("ranges", 2);
  const auto count = static_cast<Eigen::Index>(columns.size());
  family.columns.resize(family.base.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) family.columns.col(i) = vector_of(columns[i]);
  family.low.resize(static_cast<Eigen::Index>(ranges.size()));
  family.high.resize(family.low.size());
  for (size_t i = 0; i < ranges.size(); ++i)
    family.low[i] = ranges[i][0], family.high[i] = ranges[i][1];
  return family;
}

static int fit(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  Table options(L, 2);
  TorqueFitOptions asked;
  if (options.has("load")) asked.load = options.vector("load", 6);
  asked.max_force = read_per_contact(options, "max_force");
  asked.link_weights = options.boolean("link_weights", false);
  const TorqueFamily family = read_family(options);
  options.done();
  const TorqueFit r = fit_torques(world_of(L, g), g.grasp, family, asked);
  push_record(L, {{"status", preload_status(r.status)}});
  if (r.normals.size() > 0)
    set_fields(L, {{"parameters", r.parameters},
                   {"torques", r.torques},
                   {"error", r.error},
                   {"errors", r.errors},
                   {"normals", r.normals}});
  return 1;
}

// from forces along the axes of contact.frame to those of the grasp map
static Eigen::MatrixXd turns_of(lua_State* L, const GraspHandle& g, const GraspMap& map) {
  return frame_turns(map, g.grasp.points, world_of(L, g).pose(g.grasp.object).matrix());
}

static int map_rows(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  const GraspMap map = grasp_map(g.grasp.points, g.grasp.com);
  return push_rows(L, map.matrix * turns_of(L, g, map));
}

static int jacobian_rows(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  const GraspMap map = grasp_map(g.grasp.points, g.grasp.com);
  const Eigen::MatrixXd dofs =
      dof_jacobian(world_of(L, g), g.grasp, hand_jacobian(world_of(L, g), g.grasp));
  return push_rows(L, turns_of(L, g, map).transpose() * dofs);
}

static const Entry forces_methods[] = {
    {"contact_forces", guarded<forces>, R"(
Contact forces that hold the object against a load, inside the exact friction cones. The load is a wrench {fx,
fy, fz, tx, ty, tz} that acts on the object from outside, in world axes, with its torque about the object's center of mass; the object's
weight is {0, 0, -9.81 * mass, 0, 0, 0}. Objectives: "min_sum", the minimum sum of normal forces (Han, Trinkle and Li
2000; Boyd and Wegbreit 2007); "min_norm", the minimum sum of squares of the forces, the only objective that always has a unique
solution; "min_max", the minimum of the largest normal force; "max_margin", the largest possible distance from the edges of the cones and from max_force;
"max_margin_sum", the largest sum of the distances from the edges. `status`: "optimal"; "infeasible",
with a `certificate`; "unbounded" if arbitrarily large forces are optimal; "inaccurate" if the solution fails its
check: balance, cones, caps and optimum to 1e-9, and the residual of a load to 1e-7 of the load. A cap that is not reached
changes nothing. `margin`: the smallest margin of all forces, for "max_margin" including the distances from max_force; 0
if some force has to lie on an edge: then "max_margin" is optimal, but these contacts cannot keep all forces strictly inside their cones,
as without force closure. `forces`: a list of {contact, normal, tangential, torsion, mu, force, margin}: tangential
along x and y of contact.frame, force in world axes, margin from the edge of the cone [N, N m]. `unbalanced`: the
remaining wrench; `residual`: its length, with torque over rho. `joint_torques`: one per DOF. `certificate`: a motion of
the object, `twist`, along which the `power` of the load exceeds the `capacity` of caps and motors; `separation_rates`
and `sliding_rates`: those of each contact along it; `force_limit_power`, `effort_limit_power`: parts of the capacity; `contact` or
`dof`: the one that yields. `unlimited_efforts`: with torque_limits = true, names of the motors that have no limit; nil if all have one.
@param options? table  the load, the limits and the objective
@option load? number[] [N and N m]  wrench on the object that the contacts balance, {fx, fy, fz, tx, ty, tz}
@option objective? "min_sum"|"min_norm"|"min_max"|"max_margin"|"max_margin_sum" = "min_sum"  what is optimized
@option max_force? number|number[] [N, > 0]  largest normal force of each contact, or a list of one per contact
@option max_total_force? number [N, > 0]  largest sum of the normal forces
@option total_force? number [N, > 0]  prescribed sum of the normal forces
@option torque_limits? boolean|number[] = false  true: what each motor can exert, as in hand.effort_ranges; or a list of one per DOF, for both directions; false: motors exert what is needed
@option total_torque? number [N m or N, > 0]  prescribed sum over all motors, closing
@option unilateral? boolean = false  true: motors do not open
@option arms? boolean = false  true: also the motors of arms that carry the hand
@option link_weights? boolean = false  true: motors also hold the links against gravity
@option balance? "exact"|"nearest" = "exact"  nearest: the least unbalanced wrench
@return table result  `status`, `forces`, `objective`, `margin`, `residual`, `unbalanced`, `joint_torques`, `certificate`
@effect reads
> weight = {0, 0, -9.81 * flask.mass, 0, 0, 0}
> held = grasp:contact_forces{load = weight}
> held.status, held.residual < 1e-9  --> optimal, true
> grasp:contact_forces{load = weight, objective = "max_margin", max_force = 10}.margin > 0  --> true
> grasp:contact_forces{load = weight, max_force = 1e-3}.certificate.contact.body == flask  --> true
> grasp:contact_forces{load = weight, objective = "min_sun"}  --> error: did you mean 'min_sum'?
> grasp:contact_forces{load = {1, 2}}  --> error: 6)"},
    {"max_load", guarded<largest>, R"(
The largest multiple `load` of a wrench on the object that contact forces balance, in the axes of contact_forces.
`status` is "unlimited" if no cap and no torque limits it. The `certificate` names the contacts that yield beyond it.
`unlimited_efforts` as in contact_forces. With `torques` the motors keep these torques at every load; "infeasible" if they balance no multiple, 0
included.
@param options table  the direction and the limits
@option direction number[] [N and N m]  wrench whose largest multiple is computed, {fx, fy, fz, tx, ty, tz}
@like grasp:contact_forces  max_force, max_total_force, total_force, torque_limits, total_torque, unilateral, arms, link_weights
@option torques? number[] [N m or N]  of the motors, one per DOF, which they keep at every load
@return table result  `status`, `load`, `forces`, `margin`, `joint_torques`, `certificate`
@effect reads
> grasp:max_load{direction = {0, 0, -1, 0, 0, 0}, max_force = 10}.load > 1  --> true
> grasp:max_load{direction = {0, 0, -1, 0, 0, 0}}.status  --> unlimited)"},
    {"optimal_preload", guarded<preload>, R"(
The smallest torques of the motors that hold the object under each of several loads without being adjusted: their largest fraction
of the limits is minimized. By default the torques are constant, and a finger moves unless friction transmits the change of the
load to the palm or to joints at rest; with `locked` the joints do not move, as with worm gears: the torques press before the load is
applied, and each contact then yields as a spring, equally stiff in all directions. `status`: "optimal"; "infeasible" if no torques
hold all loads; "inaccurate". `torques`: one per DOF; `fraction`: largest torque as a fraction of its limit, of motors without a limit
in N m or N; `normals`: per load, the normal force of each contact [N]. At one of the loads some contact is at the edge of its cone:
loads larger than the true ones leave a margin. `unlimited_efforts` as in contact_forces.
@param options table  the loads and the limits
@option loads number[][]  wrenches on the object, {fx, fy, fz, tx, ty, tz} [N and N m] each, held one at a time
@option locked? boolean = false  true: the joints do not move under a load
@option torque_limits? boolean|number[] = true  true: those of the motors; a list of one per DOF, for both directions; false: none
@like grasp:contact_forces  max_force, unilateral, arms, link_weights
@return table result  `status`, `torques`, `fraction`, `normals`
@effect reads
> preload = grasp:optimal_preload{loads = {{0, 0, -9.81 * flask.mass, 0, 0, 0}}, locked = true}
> preload.status, #preload.torques, preload.fraction < 1  --> optimal, 12, true
> grasp:optimal_preload{loads = {}}  --> error: expected at least one load, got none
> grasp:optimal_preload{loads = {{1, 2}}}  --> error: 6)"},
    {"fit_torques", guarded<fit>, R"(
Torques of the DOFs that depend linearly on parameters, base + sum of parameters[i] * columns[i], and contact forces that balance the load: the
parameters for which the unbalanced torques of the joints are smallest. Springs and clutches act as in equilibrium. It fits
designs of tendon-driven hands (Ciocarlie and Allen 2011). `status`: "optimal"; "infeasible": no contact forces balance the load; "inaccurate".
`parameters`; `torques`: one per DOF; `errors`: unbalanced torques, one per DOF, or per joint of a compliant DOF; `error`: their
length; `normals`: normal force of each contact [N].
@param options table  the torques and the load
@option base number[] [N m or N]  torques with all parameters 0, one per DOF
@option columns number[][]  per parameter: torques per unit, one per DOF
@option ranges number[][]  per parameter: minimum and maximum
@option load? number[] [N and N m]  wrench on the object, {fx, fy, fz, tx, ty, tz}
@like grasp:contact_forces  max_force, link_weights
@return table result  `status`, `parameters`, `torques`, `errors`, `error`, `normals`
@effect reads
> torques, column = {}, {}
> for i = 1, #hand.dofs do torques[i], column[i] = 0.1, 0 end
> column[1] = 1
> fitted = grasp:fit_torques{base = torques, columns = {column}, ranges = {{-1, 1}}}
> fitted.status, #fitted.parameters, fitted.error >= 0  --> optimal, 1, true
> grasp:fit_torques{base = {0}, columns = {}, ranges = {}}  --> error: base: one number per DOF: expected 12, got 1)"},
    {"equilibrium", guarded<balance>, R"(
Can the hand in its present posture hold the load (as in contact_forces)? Its joints must be in equilibrium too: by motors through their
couplings, within hand.effort_ranges, by springs, and by the clutches of joints that have broken away. The palm resists any force. `status`: "stable"; "unstable": `unbalanced` is the smallest
remaining wrench, and `certificate` names what yields; "moving": no contact forces balance the joints, so that a
finger moves; "inaccurate".
@param options? table  the load, the torques and the limits
@option load? number[] [N and N m]  wrench on the object, {fx, fy, fz, tx, ty, tz}
@option torque_limits? boolean|number[] = true  a list of one per DOF, for both directions; false: motors exert anything
@option torques? number[]|"springs"|"limits" = "limits"  what the motors exert, one per DOF [N m or N]; springs: compliant DOFs hold by their springs alone, clutches at their full torque
@like grasp:contact_forces  max_force, arms, link_weights
@return table result  `status`, `forces`, `margin`, `residual`, `unbalanced`, `joint_torques`, `certificate`
@effect reads
> grasp:equilibrium{load = {0, 0, -0.1, 0, 0, 0}}.status  --> stable
> grasp:equilibrium{load = {0, 0, -1e4, 0, 0, 0}}.status  --> unstable
> grasp:equilibrium{torques = {1}}  --> error: expected 12, one per DOF)"},
    {"grasp_map", guarded<map_rows>, R"(
Grasp map, which takes contact forces to the wrench on the object: six rows, in the object's frame about its center of mass, unscaled.
Columns contact by contact: the normal force; with friction, the forces along x and y of contact.frame; for soft
contacts, the torque about the normal.
@return number[][]
@effect reads
> #grasp:grasp_map(), #grasp:grasp_map()[1] == 3 * #grasp.contacts  --> 6, true)"},
    {"hand_jacobian", guarded<jacobian_rows>, R"(
Velocity of the contacts per DOF: a row for each column of the grasp map, a column for each DOF, with the ratios of
its joints. Its transpose takes contact forces to motor torques. Joints that have broken away are left out.
@return number[][]
@effect reads
> #grasp:hand_jacobian()[1] == #hand.dofs  --> true)"},
};

const Class forces_class{.name = "forces",
                         .variable = "grasp",
                         .doc = "Contact forces and joint torques of a grasp.",
                         .methods = forces_methods};

}  // namespace clench
