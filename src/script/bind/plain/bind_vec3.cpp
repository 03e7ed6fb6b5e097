#include <fmt/format.h>

#include "clench/base/convert.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"

namespace clench {

using Eigen::Vector3d;

std::string vec3_text(const Vector3d& v) {
  // adding zero turns -0 into 0
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

static int make_vec3(lua_State* L) {
  if (lua_gettop(L) == 0) return push(L, Vector3d(0, 0, 0));
  if (lua_gettop(L) == 1) return push(L, check_vec3(L, 1));
  return push(L,
              Vector3d(check_number(L, 1, "x"), check_number(L, 2, "y"), check_number(L, 3, "z")));
}

static int dot(lua_State* L) { return push(L, self<Vector3d>(L).dot(check_vec3(L, 2, "other"))); }

static int cross(lua_State* L) {
  return push(L, self<Vector3d>(L).cross(check_vec3(L, 2, "other")));
}

static int unit(lua_State* L) {
  const Vector3d& v = self<Vector3d>(L);
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) fail("{}: a vector of length 0 has no direction", subject(L));
  // squares of large numbers do not overflow, and those of small ones do not underflow
  return push(L, (v / largest).normalized());
}

static int vec3_add(lua_State* L) {
  return push(L, check_vec3(L, 1, "left of +") + check_vec3(L, 2, "right of +"));
}

static int subtract(lua_State* L) {
  return push(L, check_vec3(L, 1, "left of -") - check_vec3(L, 2, "right of -"));
}

static int vec3_multiply(lua_State* L) {
  const bool left = to<Vector3d>(L, 1), right = to<Vector3d>(L, 2);
  if (left && right) fail("vec3: two vectors have no product *; use a:dot(b) or a:cross(b)");
  if (left) return push(L, *to<Vector3d>(L, 1) * check_number(L, 2, "right of *"));
  return push(L, check_number(L, 1, "left of *") * check_vec3(L, 2, "right of *"));
}

static int divide(lua_State* L) {
  const double divisor = check_number(L, 2, "right of /");
  if (divisor == 0) fail("vec3: division by 0");
  return push(L, check_vec3(L, 1, "left of /") / divisor);
}

static int vec3_item(lua_State* L) {
  const Vector3d& v = self<Vector3d>(L);
  if (lua_type(L, 2) == LUA_TNUMBER) {
    const double i = lua_tonumber(L, 2);
    if (i == 1 || i == 2 || i == 3) return push(L, v[floor_int(i) - 1]);
  }
  return 0;
}

static std::array<double, 3> numbers_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

static const Entry vec3_functions[] = {
    {"vec3", guarded<make_vec3>, R"(
A vector of three finite numbers, from a list or one by one. Wherever a vec3 is expected, {x, y, z} is accepted.
@param x? number[]|number  first component, or a list of all three; without it all are 0
@param y? number  second component, when they are given one by one
@param z? number  third component
@return vec3
@effect reads
> clench.vec3(1, 2, 3)  --> (1, 2, 3)
> clench.vec3{1, 2, 3} * 2 - {1, 1, 1}  --> (1, 3, 5)
> clench.vec3{1, 2}  --> error: expected 3 numbers, got 2
> clench.vec3(1e308, 0, 0) * 10  --> error: vec3: the result is not finite, got (inf, 0, 0))"},
};

static const Entry vec3_fields[] = {
    {"x", getter<[](const Vector3d& x) { return x.x(); }>, R"(
First coordinate.
@type number
> clench.vec3(1, 2, 3).x  --> 1.0)"},
    {"y", getter<[](const Vector3d& x) { return x.y(); }>, R"(
Second coordinate.
@type number
> clench.vec3(1, 2, 3).y  --> 2.0)"},
    {"z", getter<[](const Vector3d& x) { return x.z(); }>, R"(
Third coordinate.
@type number
> clench.vec3(1, 2, 3).z  --> 3.0
> clench.vec3(1, 2, 3)[3]  --> 3.0)"},
};

static const Entry vec3_methods[] = {
    {"dot", guarded<dot>, R"(
Scalar product.
@param other vec3  other factor
@return number
@effect reads
> clench.vec3(1, 2, 3):dot{1, 1, 1}  --> 6.0)"},
    {"cross", guarded<cross>, R"(
Vector product.
@param other vec3  other factor
@return vec3
@effect reads
> clench.vec3(1, 0, 0):cross{0, 1, 0}  --> (0, 0, 1))"},
    {"norm", method<[](const Vector3d& x) { return x.stableNorm(); }>, R"(
Length.
@return number
@effect reads
> clench.vec3(3, 4, 0):norm()  --> 5.0)"},
    {"unit", guarded<unit>, R"(
The same direction, length 1.
@return vec3
@effect reads
> clench.vec3(0, 0, 2):unit()  --> (0, 0, 1)
> clench.vec3(0, 0, 0):unit()  --> error: length 0)"},
};

static const Entry vec3_operators[] = {
    {"__add", guarded<vec3_add>, ""},
    {"__sub", guarded<subtract>, ""},
    {"__mul", guarded<vec3_multiply>, ""},
    {"__div", guarded<divide>, ""},
    {"__unm", method<[](const Vector3d& x) { return Vector3d(-x); }>, ""},
    {"__eq", equality<Vector3d>, ""},
    {"__len", method<[](const Vector3d&) { return 3; }>, ""},
    {"__index", guarded<vec3_item>, ""},
    {"__tostring", method<vec3_text>, ""},
    {"__json", method<numbers_of>, ""},
};

const Library vec3_library{.name = "clench", .doc = "", .functions = vec3_functions};

const Class vec3_class{
    .name = "vec3",
    .variable = "vec3",
    .doc =
        "A vector of three numbers. It never changes: operators `+ - * /`, `==`, unary `-` and `#` "
        "make new values; `v[1]`, `v[2]`, `v[3]` are `v.x`, `v.y`, `v.z`.",
    .fields = vec3_fields,
    .methods = vec3_methods,
    .operators = vec3_operators};

}  // namespace clench
