#include <algorithm>
#include <cmath>

#include "clench/base/suggest.h"
#include "clench/grasp/wrench/max_space_edges.h"
#include "clench/script/bind/grasp/wrench_spaces.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"
#include "clench/script/lua/watching.h"

namespace clench {

std::optional<int> read_edges(Table& options) {
  if (!options.has("edges")) return {};
  if (options.type("edges") == LUA_TSTRING) {
    const std::string word = options.string("edges");
    if (word != "exact")
      fail("{}: edges must be 3 to {} or 'exact', got '{}'", options.subject(), max_edges, word);
    return round_edges;
  }
  return options.integer("edges");
}

bool is_gyration(Table& options) {
  if (options.type("rho") != LUA_TSTRING) return false;
  const std::string word = options.string("rho");
  if (word != "gyration")
    fail("{}: rho must be a number or 'gyration', got '{}'", options.subject(), word);
  return true;
}

static int coordinate_of(const std::string& name, const What& what) {
  const auto place = std::find(coordinate_names.begin(), coordinate_names.end(), name);
  if (place == coordinate_names.end())
    fail("{}: unknown coordinate '{}', expected fx, fy, fz, tx, ty or tz", what.text(), name);
  return static_cast<int>(place - coordinate_names.begin());
}

std::optional<std::vector<int>> read_coordinates(Table& options, const char* key) {
  if (!options.has(key)) return {};
  std::vector<int> out;
  const What what = options.what(key);
  options.each(key, "a list of coordinates", [&](int i, const What& item) {
    const int c = coordinate_of(read_string(what.L, i, item), what);
    if (std::ranges::count(out, c)) fail("{}: {} is given twice", what.text(), coordinate_names[c]);
    out.push_back(c);
  });
  return out;
}

WrenchSpaceOptions read_space_options(Table& options) {
  WrenchSpaceOptions out;
  out.norm = options.choice("norm", norm_words, out.norm);
  out.coordinates = read_coordinates(options, "coordinates").value_or(out.coordinates);
  return out;
}

// a contact of the list: {point, normal, mu, torsion_radius}, or a list of wrenches
static UnitWrenches read_contact(lua_State* L, int i, const What& what, const ConeOptions& cone) {
  if (!lua_istable(L, i)) fail_expected(what, "a list of wrenches or {point, normal, mu}", i);
  // names, not numbers: a point and its cone
  bool is_point = false;
  for (const char* name : {"point", "normal", "mu", "torsion_radius"}) {
    const int type = lua_getfield(L, i, name);
    is_point = is_point || type != LUA_TNIL;
    lua_pop(L, 1);
  }
  if (is_point) {
    Table contact(L, i, what.text());
    const PointContact point{.p_O = contact.vec3("point"),
                             .n_O = contact.vec3("normal"),
                             .mu = contact.number("mu"),
                             .torsion_radius = contact.number("torsion_radius", 0)};
    contact.done();
    try {
      return unit_wrenches(point, cone);
    } catch (const Error& error) {
      fail(error.kind(), "{}: {}", what.text(), error.what());
    }
  }
  return {columns_of(read_rows(L, i, what, 6)), {}};
}

static int new_wrench_space(lua_State* L) {
  Table options(L, 1);
  ConeOptions cone;
  cone.edges = read_edges(options).value_or(cone.edges);
  cone.rho = options.number("rho", cone.rho);
  cone.p_OM = options.vec3("com", Eigen::Vector3d::Zero());
  const WrenchSpaceOptions space_options = read_space_options(options);
  std::vector<UnitWrenches> contacts;
  Eigen::Index edges = 0;
  options.each("contacts", "a list of contacts", [&](int i, const What& what) {
    contacts.push_back(read_contact(L, i, what, cone));
    edges += contacts.back().edges.cols();
    if (edges > max_space_edges)
      fail(ErrorKind::limit, "{}: contacts: expected at most {} edges in all, got more", subject(L),
           max_space_edges);
  });
  options.done();
  return push_object(
      L, WrenchSpacePtr(std::make_shared<WrenchSpace>(std::move(contacts), space_options)));
}

size_t owned_bytes(const WrenchSpacePtr& space) {
  size_t bytes = sizeof *space;
  for (const UnitWrenches& contact : space->contacts())
    bytes += sizeof contact + 4 * static_cast<size_t>(contact.edges.size()) * sizeof(double);
  return bytes;
}

static const WrenchSpace& space(lua_State* L) { return *self<WrenchSpacePtr>(L); }

const char* norm_name(const WrenchSpace& s) { return word_of(s.options().norm, norm_words); }

std::vector<const char*> names_of(std::span<const int> coordinates) {
  std::vector<const char*> names;
  for (const int c : coordinates) names.push_back(coordinate_names[c]);
  return names;
}

static int epsilon(lua_State* L) { return push(L, space(L).epsilon(Watching(L).progress())); }

static int epsilon_bounds(lua_State* L) {
  Table table(L, 2);
  EpsilonOptions options;
  options.tolerance = table.number("tolerance", options.tolerance);
  if (table.has("at_least")) options.at_least = table.number("at_least");
  table.done();
  const EpsilonBounds bounds = space(L).epsilon_bounds(options, Watching(L).progress());
  std::optional<bool> reached;
  if (options.at_least) reached = bounds.lower >= *options.at_least;
  return push_record(L, {{"lower", bounds.lower},
                         {"upper", bounds.upper},
                         {"converged", bounds.converged},
                         {"reached", reached}});
}

static int volume(lua_State* L) { return push(L, space(L).volume(Watching(L).progress())); }

static int volume_bounds(lua_State* L) {
  Table table(L, 2);
  const int edges = table.integer("edges", 32);
  table.done();
  const VolumeBounds bounds = space(L).volume_bounds(edges, Watching(L).progress());
  return push_record(L, {{"lower", bounds.lower}, {"upper", bounds.upper}});
}

static int closes_force(lua_State* L) {
  return push(L, space(L).is_force_closure(Watching(L).progress()));
}

static int weakest(lua_State* L) {
  const Weakest& w = space(L).weakest(Watching(L).progress());
  std::vector<int> contacts;
  for (const int contact : w.contacts) contacts.push_back(contact + 1);
  return push_record(
      L, {{"direction", w.direction}, {"resistance", w.resistance}, {"contacts", contacts}});
}

static int wrenches(lua_State* L) {
  const WrenchSpace& s = space(L);
  if (s.is_round()) fail("{}: round cones have no edges to list, give a number", subject(L));
  return push_list_of(L, s.contacts(), [&](const UnitWrenches& contact) {
    push_rows(L, contact.edges.transpose());
  });
}

static int space_text(lua_State* L) {
  const WrenchSpace& s = space(L);
  return push(L,
              fmt::format("{} wrench space of {} contacts, rank {}, epsilon {:.6g}", norm_name(s),
                          s.contacts().size(), s.rank(), s.epsilon(Watching(L).progress())));
}

static const Entry wrench_space_functions[] = {
    {"wrench_space", guarded<new_wrench_space>, R"(
All wrenches that contacts resist when their normal forces sum to one (norm "L1") or are each at most one ("Linf").
A contact is a list of unit wrenches {fx, fy, fz, tx, ty, tz}, torque over rho, or {point, normal, mu, torsion_radius} in
the object frame; torsion_radius [m] is that of the torsional friction of a soft finger, 0 for a hard one. Nothing
is calculated before it is requested.
@param options table  the contacts, and how they are combined
@option contacts table[]  points with their cones, or lists of wrenches {fx, fy, fz, tx, ty, tz}
@option contacts.point? vec3 [m]  contact point
@option contacts.normal? vec3  unit normal, into the object
@option contacts.mu? number [0 to 1e6]  coefficient of friction
@option contacts.torsion_radius? number [m, >= 0] = 0  of a soft contact
@option norm? "L1"|"Linf" = "L1"  L1: the normal forces sum to 1; Linf: each is at most 1
@option edges? integer|"exact" [3 to 1000] = 8  of the friction pyramids; exact: round cones
@option rho? number [m, > 0] = 1  length by which torques are divided
@option com? vec3 [m] = {0, 0, 0}  point about which torques are computed
@option coordinates? string[]  those that count, of "fx" to "tz"; all by default
@return wrench_space
@effect reads
> cross = {}
> for i = 1, 6 do for s = -1, 1, 2 do w = {0, 0, 0, 0, 0, 0} w[i] = s cross[#cross + 1] = w end end
> math.abs(clench.wrench_space{contacts = {cross}}:epsilon() - 1 / math.sqrt(6)) < 1e-12  --> true
> clench.wrench_space{contacts = {cross}, coordinates = {"fx", "fy", "fz"}}.rank  --> 3
> clench.wrench_space{contacts = {{{1, 0, 0, 0, 0}}}}  --> error: 6
> clench.wrench_space{contacts = {}, edges = 2}  --> error: edges must be 3 to 1000, got 2)"},
};

static const Entry space_fields[] = {
    {"rank", getter<[](const WrenchSpacePtr& x) { return x->rank(); }>, R"(
Dimension of the span of the wrenches, from 0 to that of the space.
@type integer
> clench.wrench_space{contacts = {{{1, 0, 0, 0, 0, 0}}}}.rank  --> 1)"},
    {"norm", getter<[](const WrenchSpacePtr& x) { return norm_name(*x); }>, R"(
"L1" or "Linf".
@type string
> grasp:wrench_space().norm  --> L1)"},
    {"coordinates",
     getter<[](const WrenchSpacePtr& x) { return names_of(x->options().coordinates); }>, R"(
The coordinates of the space.
@type string[]
> #grasp:wrench_space().coordinates  --> 6)"},
};

static const Entry space_methods[] = {
    {"epsilon", guarded<epsilon>, R"(
Radius of the largest ball of resisted wrenches; 0 without force closure. Accurate to 1e-12, with round cones to 1e-9
or, if that takes too many facets (rings of equal contacts, large friction), a certified lower bound: epsilon_bounds
returns both bounds.
@return number
@effect reads
> grasp:wrench_space():epsilon() == grasp:quality "epsilon"  --> true)"},
    {"epsilon_bounds", guarded<epsilon_bounds>, R"(
Certified bounds of epsilon, no tighter than necessary: refinement ends when upper - lower is within the tolerance (1e-6),
or as soon as epsilon is known to reach or miss at_least.
@param options? table  when it ends
@option tolerance? number [>= 0] = 1e-6  sufficient difference of the bounds
@option at_least? number  end as soon as it is known whether epsilon is that large
@return {lower: number, upper: number, converged: boolean, reached?: boolean}  converged: within the tolerance; reached: lower >= at_least
@effect long
> bounds = grasp:wrench_space{edges = "exact"}:epsilon_bounds{tolerance = 1e-3}
> bounds.lower <= bounds.upper and bounds.upper <= bounds.lower + 1e-3  --> true
> grasp:wrench_space():epsilon_bounds{at_least = 1}.reached  --> false)"},
    {"volume", guarded<volume>, R"(
Volume in the coordinates of the space; 0 if the space is flat. With round cones, the middle of volume_bounds. With "Linf",
about five hard contacts of eight edges or three soft ones are the maximum: more than 60,000 cells are an error that states
so.
@return number
@effect reads
> grasp:wrench_space():volume() == grasp:quality "volume"  --> true)"},
    {"volume_bounds", guarded<volume_bounds>, R"(
Certified bounds of the volume: with round cones, the volume for pyramids inside the cones and that for the same pyramids enlarged until they
enclose the cones. Without round cones both are the volume.
@param options? table  how exact they are
@option edges? integer [4 to 1000] = 32  of the pyramids
@return {lower: number, upper: number}
@effect long
> exact = grasp:wrench_space{edges = "exact"}
> bounds = exact:volume_bounds()
> bounds.lower < exact:volume() and exact:volume() < bounds.upper and bounds.upper < 1.05 * bounds.lower  --> true
> bounds.lower > grasp:quality "volume"  --> true
> exact:volume_bounds{edges = 16}.lower < bounds.lower  --> true)"},
    {"is_force_closure", guarded<closes_force>, R"(
Is every wrench resisted?
@return boolean
@effect reads
> grasp:wrench_space():is_force_closure()  --> true)"},
    {"weakest", guarded<weakest>, R"(
The wrench on the object that is resisted least, and the contacts that yield first as it grows.
@return {direction: number[], resistance: number, contacts: index[]}  unit wrench, torque over rho; its largest multiple resisted, below 0 when all contacts push along it; numbers of the contacts that push against it at their limit
@effect reads
> w = grasp:wrench_space():weakest()
> math.abs(w.resistance - grasp:quality "epsilon") < 1e-12 and #w.contacts >= 1  --> true)"},
    {"wrenches", guarded<wrenches>, R"(
The unit wrenches, contact by contact.
@return number[][][]
@effect reads
> #grasp:wrench_space():wrenches() == #grasp.contacts  --> true
> grasp:wrench_space{edges = "exact"}:wrenches()  --> error: round cones)"},
    {"project", guarded<project_space>, R"(
The space in three coordinates. Of the others, `fixed` ones have a value, which gives a section, and `projected` ones may have
any value, which gives a projection.
@param options? table  the three coordinates that remain
@option fixed? table  values of coordinates, {tx = 0, ty = 0, tz = 0}
@option fixed.fx? number  value of this coordinate
@option fixed.fy? number  value of this coordinate
@option fixed.fz? number  value of this coordinate
@option fixed.tx? number  value of this coordinate
@option fixed.ty? number  value of this coordinate
@option fixed.tz? number  value of this coordinate
@option projected? string[]  coordinates that are projected out
@option tolerance? number [> 0] = 1e-3  of round cones, relative to the size of the space
@return projection
@effect long
> section = grasp:wrench_space():project{fixed = {tx = 0, ty = 0, tz = 0}}
> projection = grasp:wrench_space():project{projected = {"tx", "ty", "tz"}}
> section.volume > 0 and section.volume <= projection.volume  --> true
> grasp:wrench_space():project{fixed = {tx = 0}}  --> error: expected three free coordinates, got 5)"},
};

static const Entry space_operators[] = {
    {"__tostring", guarded<space_text>, ""},
};

const Library wrench_space_library{
    .name = "clench", .doc = "", .functions = wrench_space_functions};

const Class wrench_space_class{
    .name = "wrench_space",
    .variable = "space",
    .doc = "Which wrenches the contacts resist, and with how much effort.",
    .fields = space_fields,
    .methods = space_methods,
    .operators = space_operators};

}  // namespace clench
