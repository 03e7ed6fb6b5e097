#include <cmath>

#include "clench/grasp/force/resistance.h"
#include "clench/grasp/measure/measures.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/grasp/wrench_spaces.h"
#include "clench/script/bind/handles.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

static int quality(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  const std::string name = check_string(L, 2, "measure");
  const Measure& measure = find_measure(name);
  const Watching watching(L);
  MeasuredGrasp measured(world_of(L, g), g.grasp, watching.progress());
  const double value = measure.of(measured);
  g.grasp.measures[name] = value;
  return push_unbounded(L, value);
}

// empty: infinite or not available, such as the volume of a hull of millions of facets or of one
// that rounding broke
static std::optional<double> value_if(const Measure& measure, MeasuredGrasp& grasp) {
  try {
    const double value = measure.of(grasp);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::limit && error.kind() != ErrorKind::internal) throw;
    return {};
  }
}

static int quality_all(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  check_unmoved(world_of(L, g), g.grasp);
  const Watching watching(L);
  MeasuredGrasp measured(world_of(L, g), g.grasp, watching.progress());
  push_list(L, 0, static_cast<int>(measures().size()));
  for (const Measure& measure : measures()) {
    const auto value = value_if(measure, measured);
    if (!value) continue;
    g.grasp.measures[std::string(measure.name)] = *value;
    set_field(L, std::string(measure.name).c_str(), *value);
  }
  return 1;
}

static int resist(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  Table options(L, 2);
  ResistanceOptions resisting;
  resisting.norm = options.choice("norm", norm_words, resisting.norm);
  const bool one = options.has("wrench"), many = options.has("wrenches"),
             ellipsoid = options.has("ellipsoid");
  if (one + many + ellipsoid != 1)
    fail("{}: expected one of wrench, wrenches and ellipsoid, got {} of them", subject(L),
         one + many + ellipsoid);
  const auto times = [&](const Vector6d& wrench, const std::string& key) {
    if (wrench.isZero(0))
      fail("{}: {}: expected a wrench that is not zero: there is nothing to resist", subject(L),
           key);
    return resistance(world_of(L, g), g.grasp, wrench, resisting);
  };
  double least = INFINITY;
  if (one) least = times(options.vector("wrench", 6), "wrench");
  const auto rows = many ? options.rows("wrenches", 6) : std::vector<std::vector<double>>();
  if (many && rows.empty()) fail("{}: wrenches: expected at least one, got none", subject(L));
  for (size_t i = 0; i < rows.size(); ++i)
    least = std::min(least, times(vector_of(rows[i]), fmt::format("wrenches[{}]", i + 1)));
  if (ellipsoid)
    least =
        ellipsoid_resistance(world_of(L, g), g.grasp, options.vector("ellipsoid", 6), resisting);
  options.done();
  return push_unbounded(L, least);
}

static int push(lua_State* L, const Measure& m) {
  return push_record(L, {{"name", m.name},
                         {"what", m.what},
                         {"range", m.range},
                         {"unit", m.unit},
                         {"higher_is_better", m.higher_is_better},
                         {"source", m.source}});
}

static int list_measures(lua_State* L) { return push(L, measures()); }

static const Entry measures_functions[] = {
    {"measures", guarded<list_measures>, R"(
The measures that grasp:quality knows, in the order of the guide.
@return {name: string, what: string, range: string, unit: string, higher_is_better: boolean, source: string}[]
@effect reads
> clench.measures()[1].name, clench.measures()[1].source  --> epsilon, Ferrari and Canny (1992))"},
};

static const Entry measures_methods[] = {
    {"quality", guarded<quality>, R"(
A measure of the grasp by name: "epsilon", "volume" and all that clench.measures() lists with definition, range, unit and
source. Infinite if there is nothing to measure, such as the clearance of a hand alone. The world must be in the state in which
the grasp was measured.
@param measure string  name of a quality measure, from clench.measures
@return number
@effect reads
> grasp:quality "epsilon" > 0  --> true
> grasp:quality "epsilon_linf" >= grasp:quality "epsilon"  --> true
> grasp:quality "epsilom"  --> error: did you mean 'epsilon'?)"},
    {"quality_all", guarded<quality_all>, R"(
All measures at once, by name, without those that are infinite and those that are not available, such as the volume of
too many contacts with too many edges.
@return table<string, number>
@effect reads
> q = grasp:quality_all()
> q.epsilon == grasp:quality "epsilon", q.isotropy > 0  --> true, true)"},
    {"resistance", guarded<resist>, R"(
The largest multiple of a wrench on the object that contact forces in round cones balance, with normal forces that sum to
at most one newton (norm "L1") or are each at most one newton ("Linf"); for several wrenches the smallest such multiple; for an ellipsoid the
largest multiple that is resisted completely, with the friction cones of the grasp. World axes, torques about the center of mass.
@param options table  one of wrench, wrenches and ellipsoid
@option wrench? number[] [N and N m]  {fx, fy, fz, tx, ty, tz}
@option wrenches? number[][] [N and N m]  the least over all
@option ellipsoid? number[] [N and N m]  half axes of an ellipsoid of wrenches
@option norm? "L1"|"Linf" = "L1"  as of wrench spaces
@return number
@effect reads
> weight = {0, 0, -9.81 * flask.mass, 0, 0, 0}
> grasp:resistance{wrench = weight} > 0  --> true
> grasp:resistance{wrenches = {weight, {1, 0, 0, 0, 0, 0}}} <= grasp:resistance{wrench = weight}  --> true
> grasp:resistance{ellipsoid = {1, 1, 1, 0.1, 0.1, 0.1}} > 0  --> true
> grasp:resistance{wrench = {0, 0, 0, 0, 0, 0}}  --> error: expected a wrench that is not zero
> grasp:resistance{}  --> error: expected one of wrench, wrenches and ellipsoid, got 0 of them)"},
};

const Library measures_library{.name = "clench", .doc = "", .functions = measures_functions};

const Class measures_class{.name = "measures",
                           .variable = "grasp",
                           .doc = "Measures of a grasp: quality, resistance, wrench spaces.",
                           .methods = measures_methods,
                           .parent = &forces_class};

}  // namespace clench
