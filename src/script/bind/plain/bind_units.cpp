#include <chrono>

#include "clench/base/units.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"

namespace clench {

static int rad(lua_State* L) { return push(L, check_number(L, 1, "degrees") * units::degree); }
static int deg(lua_State* L) { return push(L, check_number(L, 1, "radians") / units::degree); }
static int mm(lua_State* L) {
  return push(L, check_number(L, 1, "millimeters") * units::millimeter);
}
static int version(lua_State* L) { return push(L, CLENCH_VERSION); }

static int clock_now(lua_State* L) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return push(L, std::chrono::duration<double>(now).count());
}

static int type_of(lua_State* L) {
  if (lua_isuserdata(L, 1) && luaL_getmetafield(L, 1, "__name") == LUA_TSTRING) return 1;
  lua_pushstring(L, lua_isnoneornil(L, 1) ? "nil" : luaL_typename(L, 1));
  return 1;
}

static const Entry units_functions[] = {
    {"type", guarded<type_of>, R"(
The type of a value: that of Lua, or the name of its class.
@param value any  any value
@return string
@effect reads
> clench.type(hand), clench.type(clench.vec3(1, 2, 3)), clench.type {}  --> robot, vec3, table)"},
    {"rad", guarded<rad>, R"(
Degrees to radians.
@param degrees number [degrees]  angle
@return number  [rad]
@effect reads
> clench.rad(180) == math.pi  --> true
> clench.rad "90"  --> error: clench.rad: degrees: expected a number, got '90')"},
    {"deg", guarded<deg>, R"(
Radians to degrees.
@param radians number [rad]  angle
@return number  [deg]
@effect reads
> clench.deg(math.pi)  --> 180.0)"},
    {"mm", guarded<mm>, R"(
Millimeters to meters.
@param millimeters number [mm]  length
@return number  [m]
@effect reads
> clench.mm(25)  --> 0.025)"},
    {"clock", guarded<clock_now>, R"(
Seconds of a monotonic clock with an arbitrary origin, to measure durations.
@return number  [s]
@effect reads
> before = clench.clock()
> clench.clock() >= before  --> true)"},
};

static const Entry units_fields[] = {
    {"version", guarded<version>, R"(
Version of the engine, major.minor.patch.
@type string
> #clench.version >= 5  --> true)"},
};

const Library units_library{.name = "clench",
                            .doc =
                                "Closes robot hands on objects and judges the grasps. Lengths are "
                                "meters, angles radians, masses kilograms, forces newtons; poses "
                                "and vectors are in the world frame unless a text says otherwise.",
                            .functions = units_functions,
                            .fields = units_fields};

}  // namespace clench
