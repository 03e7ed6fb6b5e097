#include "script/bind_grasp.h"

#include "base/suggest.h"
#include "script/bind_contact.h"
#include "script/bind_forces.h"
#include "script/bind_log.h"
#include "script/bind_patch.h"
#include "script/guard.h"
#include "script/push.h"
#include "script/table.h"

namespace clench {

static int measure(lua_State* L) {
  check_count(L, 3);
  const auto& hand = check_object<RobotHandle>(L, 1, "hand");
  const auto& object = check_object<BodyHandle>(L, 2, "object");
  if (hand.world != object.world)
    fail("{}: '{}' and '{}' belong to different worlds", subject(L), hand->name, object->name);
  Table options(L, 3);
  GraspOptions grasp;
  grasp.edges = options.integer("edges", grasp.edges);
  if (options.has("rho")) grasp.rho = options.number("rho");
  grasp.soft = options.boolean("soft", grasp.soft);
  grasp.normal_force = options.positive("normal_force", grasp.normal_force);
  grasp.modulus = read_modulus_rule(options);
  options.done();
  Grasp measured = measure_grasp(*hand.world, hand.id, object.id, grasp);
  if (measured.sharp_contacts > 0)
    log_warning(L, fmt::format("grasp of {} by {}: {} of {} contacts are soft ones on corners or "
                               "edges, whose patch is a guess",
                               object->name, hand->name, measured.sharp_contacts,
                               measured.contacts.size()));
  return push_object(L, GraspHandle{hand.world, std::move(measured), nullptr});
}

static const WrenchSpacePtr& space_of(GraspHandle& handle) {
  if (!handle.space) handle.space = std::make_shared<WrenchSpace>(wrench_space(handle.grasp));
  return handle.space;
}

static int get_hand(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  return push(L, RobotHandle{g.world, g.grasp.hand});
}

static int get_object(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  return push(L, BodyHandle{g.world, g.grasp.object});
}

static int get_contacts(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  return push_contacts(L, g.world, g.grasp.contacts);
}

static int get_rho(lua_State* L) { return push(L, self<GraspHandle>(L).grasp.rho); }
static int get_edges(lua_State* L) { return push(L, self<GraspHandle>(L).grasp.edges); }

static int grasp_space(lua_State* L) {
  check_count(L, 0);
  return push_object(L, space_of(self<GraspHandle>(L)));
}

static int is_force_closure(lua_State* L) {
  check_count(L, 0);
  return push(L, space_of(self<GraspHandle>(L))->is_force_closure());
}

static int quality(lua_State* L) {
  check_count(L, 1);
  auto& g = self<GraspHandle>(L);
  const std::string name = check_string(L, 2, "measure");
  if (name == "epsilon") return push(L, space_of(g)->epsilon());
  if (name == "volume") return push(L, space_of(g)->volume());
  fail("{}: unknown measure '{}', wanted 'epsilon' or 'volume'{}", subject(L), name,
       did_you_mean(name, {"epsilon", "volume"}));
}

static int grasp_text(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  return push(
      L, fmt::format("grasp of {} contacts, epsilon {:.6g}, volume {:.6g}", g.grasp.contacts.size(),
                     space_of(g)->epsilon(), space_of(g)->volume()));
}

// --- wrench spaces ---

// a contact of the list: {point, normal, mu}, or a list of wrenches
static Wrenches read_contact(lua_State* L, int i, const What& what, const ConeOptions& cone) {
  if (!lua_istable(L, i)) fail_wanted(what, "a list of wrenches or {point, normal, mu}", i);
  lua_pushliteral(L, "normal");
  lua_rawget(L, i);
  const bool is_point = !lua_isnil(L, -1);
  lua_pop(L, 1);
  if (is_point) {
    Table contact(L, i, what.text());
    const PointContact point{
        .p_O = contact.vec3("point"), .n_O = contact.vec3("normal"), .mu = contact.number("mu")};
    contact.done();
    return cone_wrenches(point, cone);
  }
  const auto rows = read_rows(L, i, what, 6);
  Wrenches wrenches(6, static_cast<int>(rows.size()));
  for (size_t c = 0; c < rows.size(); ++c)
    wrenches.col(static_cast<int>(c)) = Eigen::Map<const Vector6d>(rows[c].data());
  return wrenches;
}

static int new_wrench_space(lua_State* L) {
  check_count(L, 1);
  Table options(L, 1);
  options.choice("norm", {"L1"}, "L1");
  ConeOptions cone;
  cone.edges = options.integer("edges", cone.edges);
  cone.rho = options.positive("rho", cone.rho);
  cone.p_OM = options.vec3("com", Eigen::Vector3d::Zero());
  std::vector<Wrenches> contacts;
  if (options.push("contacts") != LUA_TTABLE)
    fail_wanted(options.what("contacts"), "a list of contacts", -1);
  const int list = lua_gettop(L);
  const int count = static_cast<int>(lua_rawlen(L, list));
  for (int i = 1; i <= count; ++i) {
    lua_rawgeti(L, list, i);
    contacts.push_back(read_contact(L, lua_gettop(L), options.what("contacts").item(i), cone));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  options.done();
  return push_object(L, WrenchSpacePtr(std::make_shared<WrenchSpace>(std::move(contacts))));
}

static const WrenchSpace& space(lua_State* L) { return *self<WrenchSpacePtr>(L); }

static int epsilon(lua_State* L) {
  check_count(L, 0);
  return push(L, space(L).epsilon());
}
static int volume(lua_State* L) {
  check_count(L, 0);
  return push(L, space(L).volume());
}
static int closes_force(lua_State* L) {
  check_count(L, 0);
  return push(L, space(L).is_force_closure());
}
static int get_rank(lua_State* L) { return push(L, space(L).rank()); }

static int weakest(lua_State* L) {
  check_count(L, 0);
  const Weakest& w = space(L).weakest();
  push_list(L, 0, 2);
  push_vector(L, w.direction);
  lua_setfield(L, -2, "direction");
  set_field(L, "resistance", w.resistance);
  return 1;
}

static int wrenches(lua_State* L) {
  check_count(L, 0);
  return push_list_of(L, space(L).contacts(),
                      [&](const Wrenches& contact) { push_rows(L, contact.transpose()); });
}

static int space_text(lua_State* L) {
  const WrenchSpace& s = space(L);
  return push(L, fmt::format("L1 wrench space of {} contacts, rank {}, epsilon "
                             "{:.6g}, volume {:.6g}",
                             s.contacts().size(), s.rank(), s.epsilon(), s.volume()));
}

static const Entry functions[] = {
    {"grasp", guarded<measure>, R"(
The grasp of a hand on an object as it is now. No contact is no error: such a grasp resists nothing.
@param hand robot
@param object body
@param options? {edges?: integer, rho?: number, soft?: boolean, normal_force?: number, modulus?: string}  edges of the friction pyramids, 8; torque length, by default the object's largest radius about its centre of mass [m]; soft: soft contacts resist turns about their normals, else all are points; normal_force: at which they are judged, 5 [N]; modulus: as of `patch:ellipse`
@return grasp
> clench.grasp(hand, flask):is_force_closure()  --> true)"},
    {"wrench_space", guarded<new_wrench_space>, R"(
All wrenches that contacts resist when their normal forces sum to at most one (norm "L1"). A contact is a list of unit
wrenches {fx, fy, fz, tx, ty, tz}, torque over rho, or {point, normal, mu} in the object frame.
@param options {contacts: table[], norm?: string, edges?: integer, rho?: number, com?: vec3}
@return wrench_space
> cross = {}
> for i = 1, 6 do for s = -1, 1, 2 do w = {0, 0, 0, 0, 0, 0} w[i] = s cross[#cross + 1] = w end end
> math.abs(clench.wrench_space{contacts = {cross}}:epsilon() - 1 / math.sqrt(6)) < 1e-12  --> true
> clench.wrench_space{contacts = {{{1, 0, 0, 0, 0}}}}  --> error: 6)"},
};

static const Entry grasp_fields[] = {
    {"hand", guarded<get_hand>, R"(
The robot that grasps.
@type robot
> grasp.hand == hand  --> true)"},
    {"object", guarded<get_object>, R"(
The body that is grasped.
@type body
> grasp.object == flask  --> true)"},
    {"contacts", guarded<get_contacts>, R"(
The contacts on the object when the grasp was measured.
@type contact[]
> grasp.contacts[1].body == flask  --> true)"},
    {"rho", guarded<get_rho>, R"(
Length that torques are divided by.
@type number  [m]
> grasp.rho > 0  --> true)"},
    {"edges", guarded<get_edges>, R"(
Edges of each friction pyramid.
@type integer
> grasp.edges  --> 8)"},
};

static const Entry grasp_methods[] = {
    {"quality", guarded<quality>, R"(
A measure of the grasp: "epsilon", the radius of the largest ball of wrenches that it resists (0 unless force closure;
Ferrari and Canny 1992), or "volume" of its wrench space.
@param measure string
@return number
> grasp:quality "epsilon" > 0  --> true
> grasp:quality "epsilom"  --> error: did you mean 'epsilon'?)"},
    {"is_force_closure", guarded<is_force_closure>, R"(
Can it resist every wrench?
@return boolean
> grasp:is_force_closure()  --> true)"},
    {"wrench_space", guarded<grasp_space>, R"(
Its L1 wrench space about the object's centre of mass.
@return wrench_space
> grasp:wrench_space().rank  --> 6)"},
};

static const Entry grasp_operators[] = {
    {"__tostring", guarded<grasp_text>, ""},
};

static const Entry space_fields[] = {
    {"rank", guarded<get_rank>, R"(
Dimension that the wrenches span, 0 to 6.
@type integer
> clench.wrench_space{contacts = {{{1, 0, 0, 0, 0, 0}}}}.rank  --> 1)"},
};

static const Entry space_methods[] = {
    {"epsilon", guarded<epsilon>, R"(
Radius of the largest ball of wrenches that is resisted; 0 unless force closure.
@return number
> grasp:wrench_space():epsilon() == grasp:quality "epsilon"  --> true)"},
    {"volume", guarded<volume>, R"(
Volume in the six dimensions of wrenches; 0 below rank 6.
@return number
> grasp:wrench_space():volume() == grasp:quality "volume"  --> true)"},
    {"is_force_closure", guarded<closes_force>, R"(
Is every wrench resisted?
@return boolean
> grasp:wrench_space():is_force_closure()  --> true)"},
    {"weakest", guarded<weakest>, R"(
The wrench on the object that is resisted worst.
@return {direction: number[], resistance: number}  unit wrench, torque over rho; its largest multiple resisted
> w = grasp:wrench_space():weakest()
> math.abs(w.resistance - grasp:quality "epsilon") < 1e-12  --> true)"},
    {"wrenches", guarded<wrenches>, R"(
The unit wrenches, contact by contact.
@return number[][][]
> #grasp:wrench_space():wrenches() == #grasp.contacts  --> true)"},
};

static const Entry space_operators[] = {
    {"__tostring", guarded<space_text>, ""},
};

const Library grasp_library{.name = "clench", .doc = "", .functions = functions};

const Class grasp_class{.name = "grasp",
                        .variable = "grasp",
                        .doc =
                            "A hand, an object and the contacts between them, "
                            "as they were when the grasp was measured.",
                        .fields = grasp_fields,
                        .methods = grasp_methods,
                        .operators = grasp_operators,
                        .parent = &forces_class};

const Class wrench_space_class{.name = "wrench_space",
                               .variable = "space",
                               .doc = "Which wrenches contacts resist, with how much effort.",
                               .fields = space_fields,
                               .methods = space_methods,
                               .operators = space_operators};

}  // namespace clench
