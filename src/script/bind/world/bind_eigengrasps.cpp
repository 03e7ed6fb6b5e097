#include "clench/io/graspit/eigengrasps.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

using Eigen::VectorXd;

EigengraspSet EigengraspsHandle::value() const {
  if (set) return *set;
  return robot->eigengrasps ? *robot->eigengrasps
                            : identity_eigengrasps(static_cast<int>(robot->dofs.size()));
}

VectorXd check_amplitudes(lua_State* L, int i, const Eigengrasps& grasps) {
  const auto values = read_numbers(L, i, {L, {}, "amplitudes"});
  if (static_cast<int>(values.size()) != grasps.size())
    fail("{}: expected {} amplitudes, got {}", subject(L), grasps.size(), values.size());
  return vector_of(values);
}

static VectorXd check_posture(const std::vector<double>& values, const std::string& subject,
                              const Eigengrasps& grasps) {
  if (static_cast<int>(values.size()) != grasps.dofs())
    fail("{}: expected {} DOF values, got {}", subject, grasps.dofs(), values.size());
  return vector_of(values);
}

// --- construction ---

static std::vector<std::optional<Range>> read_limits(Table& options) {
  std::vector<std::optional<Range>> limits;
  for (const auto& row : options.rows("limits", 2)) limits.push_back(Range{row[0], row[1]});
  return limits;
}

static EigengraspSet set_from_vectors(Table& options) {
  EigengraspSet set;
  const auto rows = options.rows("vectors");
  set.dofs = rows.empty() ? 0 : static_cast<int>(rows.front().size());
  const int count = static_cast<int>(rows.size());
  const auto values = options.has("eigenvalues") ? options.numbers("eigenvalues", count)
                                                 : std::vector<double>(rows.size(), 0.5);
  std::vector<std::optional<Range>> limits(rows.size());
  if (options.has("limits")) limits = read_limits(options);
  if (static_cast<int>(limits.size()) != count)
    fail("{}: limits: expected {} pairs, got {}", options.subject(), count, limits.size());
  for (int i = 0; i < count; ++i) set.grasps.push_back({vector_of(rows[i]), values[i], limits[i]});
  if (options.has("origin")) set.origin = options.vector("origin");
  if (options.has("norm")) set.norm = options.vector("norm");
  return set;
}

static int make(lua_State* L) {
  Table options(L, 1);
  EigengraspSet set;
  if (options.has("postures") && options.has("vectors"))
    fail("{}: expected postures or vectors, got both", subject(L));
  if (options.has("postures")) {
    std::vector<VectorXd> postures;
    for (const auto& row : options.rows("postures")) postures.push_back(vector_of(row));
    set = principal_eigengrasps(postures, options.integer("count", 0));
  } else if (options.has("vectors")) {
    set = set_from_vectors(options);
  } else {
    fail("{}: expected postures or vectors", subject(L));
  }
  options.done();
  check_eigengrasps(set, subject(L));
  return push_object(L, EigengraspsHandle{{}, std::make_shared<EigengraspSet>(std::move(set))});
}

// --- fields ---

static Eigengrasps ready(lua_State* L) { return self<EigengraspsHandle>(L).ready(); }

static std::vector<Range> amplitude_limits(const EigengraspsHandle& x) {
  const Eigengrasps grasps = x.ready();
  return grasps.limits(x.robot.world ? x.robot.world->dofs(x.robot.id) : grasps.origin());
}

// --- methods ---

static int amplitudes(lua_State* L) {
  const auto& handle = self<EigengraspsHandle>(L);
  const Eigengrasps grasps = handle.ready();
  if (!given(L, 2) && handle.robot.world)
    return push(L, grasps.amplitudes(handle.robot.world->dofs(handle.robot.id)));
  const auto values = check_numbers(L, 2, "dofs");
  return push(L, grasps.amplitudes(check_posture(values, subject(L), grasps)));
}

static int dofs(lua_State* L) {
  const Eigengrasps grasps = ready(L);
  const VectorXd amplitudes = check_amplitudes(L, 2, grasps);
  Table options(L, 3);
  std::optional<VectorXd> from;
  if (options.has("from"))
    from = check_posture(options.numbers("from"), options.subject() + ": from", grasps);
  options.done();
  return push(L, from ? grasps.posture(amplitudes, *from) : grasps.posture(amplitudes));
}

static int eigengrasps_save(lua_State* L) {
  const auto& handle = self<EigengraspsHandle>(L);
  write_eigengrasps(handle.value(), check_output(L, 2), log_losses(L));
  return 0;
}

static std::string text_of_eigengrasps(const EigengraspsHandle& x) {
  if (x.robot.world && !x.robot.world->alive(x.robot.id)) return "eigengrasps of a removed robot";
  const Eigengrasps grasps = x.ready();
  return fmt::format("{} eigengrasp{} of {} DOFs", grasps.size(), grasps.size() == 1 ? "" : "s",
                     grasps.dofs());
}

// --- tables ---

static const Entry eigengrasps_functions[] = {
    {"eigengrasps", guarded<make>, R"(
A set of eigengrasps: the principal components of `postures`, the strongest first, with their mean as the origin; or
the given `vectors`, normalized. The largest entry of each principal component is positive, and its eigenvalue is the
variance along it. `count` keeps the first ones. Give the set to a hand: hand.eigengrasps = set.
@param options table  postures to analyze, or the vectors themselves
@option postures? number[][] [rad or m]  DOF values, whose principal components are computed
@option count? integer [>= 1]  largest number of eigengrasps from postures
@option vectors? number[][]  one per eigengrasp, instead of postures
@option eigenvalues? number[]  one per vector, 0.5 by default
@option origin? number[] [rad or m]  posture at which all amplitudes are 0
@option norm? number[]  scales of the DOFs
@option limits? number[][]  {low, high} of each amplitude
@return eigengrasps
@effect reads
> set = clench.eigengrasps{postures = {{0, 0}, {1, 2}, {2, 4}}}
> #set  --> 1
> math.abs(set.vectors[1][2] / set.vectors[1][1] - 2) < 1e-12  --> true
> set.origin  --> {1.0, 2.0}
> clench.eigengrasps{postures = {{0, 0}}}  --> error: expected at least 2 postures, got 1)"},
};

static const Entry eigengrasps_fields[] = {
    {"vectors", getter<[](const EigengraspsHandle& x) { return x.ready().vectors(); }>, R"(
A unit vector for each eigengrasp, one number per DOF.
@type number[][]
> #hand.eigengrasps.vectors[1]  --> 12)"},
    {"eigenvalues", getter<[](const EigengraspsHandle& x) { return x.ready().eigenvalues(); }>, R"(
Weight of each eigengrasp; for principal components, the variance of the postures along it.
@type number[]
> set = clench.eigengrasps{postures = {{0, 0}, {1, 0}, {2, 0}}}
> set.eigenvalues  --> {1.0})"},
    {"origin", getter<[](const EigengraspsHandle& x) { return x.ready().origin(); }>, R"(
The posture of zero amplitudes, within the DOF limits. If no file defines it, the middle of the limits.
@type number[]  [rad or m]
> #hand.eigengrasps.origin  --> 12)"},
    {"norm", getter<[](const EigengraspsHandle& x) { return x.ready().norm(); }>, R"(
Scale of the vectors' entries, one per DOF.
@type number[]
> clench.eigengrasps{vectors = {{1, 1}}}.norm  --> {1.0, 1.0})"},
    {"limits", getter<amplitude_limits>, R"(
Range of each amplitude from the hand's posture, with the others constant: that of its file, otherwise until the first
DOF that it moves is at a limit.
@type number[][]  {least, largest} each
> hand.eigengrasps = nil
> limits, range = hand.eigengrasps.limits[1], hand.dof_limits[1]
> math.abs((limits[2] - limits[1]) - (range[2] - range[1])) < 1e-12  --> true)"},
    {"range", getter<[](const EigengraspsHandle& x) { return x.ready().range(); }>, R"(
Overall range of each amplitude: that of its file, otherwise the minimum and maximum over all postures within the DOF limits.
@type number[][]  {least, largest} each
> range = hand.eigengrasps.range[1]
> range[1] < range[2]  --> true)"},
    {"hand", getter<[](const EigengraspsHandle& x) {
       return x.robot.world ? std::optional(x.robot) : std::nullopt;
     }>,
     R"(
The hand that the set belongs to; nil for an independent set.
@type robot?
> hand.eigengrasps.hand == hand  --> true
> clench.eigengrasps{vectors = {{1}}}.hand  --> nil)"},
    {"is_custom", getter<[](const EigengraspsHandle& handle) {
       return handle.set || handle.robot->eigengrasps;
     }>,
     R"(
Is the set from a file or a script? A hand without a set has one eigengrasp per DOF.
@type boolean
> hand.eigengrasps = nil
> hand.eigengrasps.is_custom  --> false
> #hand.eigengrasps  --> 12)"},
    {"count", getter<[](const EigengraspsHandle& x) { return x.ready().size(); }>, R"(
Number of eigengrasps, like #.
@type integer
> clench.eigengrasps{vectors = {{1, 1}}}.count  --> 1)"},
};

static const Entry eigengrasps_methods[] = {
    {"amplitudes", guarded<amplitudes>, R"(
Amplitudes for which the set's posture is nearest to the DOF values; without these, to the hand's own.
@param dofs? number[]  [rad or m]
@return number[]
@effect reads
> set = clench.eigengrasps{vectors = {{1, 0, 0}, {0, 3, 4}}}
> set:amplitudes{2, 3, 4}  --> {2.0, 5.0}
> set:amplitudes{1}  --> error: expected 3 DOF values, got 1)"},
    {"dofs", guarded<dofs>, R"(
DOF values of amplitudes; they may lie outside the limits. With `from`, the component of that posture that no
amplitudes represent is kept.
@param amplitudes number[]  one amplitude per eigengrasp
@param options? table  the posture to begin with
@option from? number[] [rad or m]  posture whose part outside of the eigengrasps is kept
@return number[]  [rad or m]
@effect reads
> set = clench.eigengrasps{vectors = {{1, 0, 0}, {0, 3, 4}}}
> set:dofs{2, 5}  --> {2.0, 3.0, 4.0}
> set:dofs({2, 5}, {from = {0, 4, -3}})  --> {2.0, 7.0, 1.0}
> set:dofs{1}  --> error: expected 2 amplitudes, got 1)"},
    {"save", guarded<eigengrasps_save>, R"(
Writes the set to a file, .egr or .xml; clench.files.eigengrasps reads it.
@param path string  file to write; its ending selects the format
@effect files
> hand.eigengrasps:save "eigengrasps.doc"  --> error: expected a file of eigengrasps, .egr or .xml, got '.doc')"},
};

static const Entry eigengrasps_operators[] = {
    {"__len", method<[](const EigengraspsHandle& x) { return x.ready().size(); }>, ""},
    {"__tostring", method<text_of_eigengrasps>, ""},
};

const Class eigengrasps_class{.name = "eigengrasps",
                              .variable = "eigengrasps",
                              .doc =
                                  "A basis of a hand's postures: each posture is an origin plus an "
                                  "amplitude times a vector for each eigengrasp.",
                              .fields = eigengrasps_fields,
                              .methods = eigengrasps_methods,
                              .operators = eigengrasps_operators};

const Library eigengrasps_library{.name = "clench", .doc = "", .functions = eigengrasps_functions};

}  // namespace clench
