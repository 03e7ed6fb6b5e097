#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"

namespace clench {

static int make_random(lua_State* L) {
  const auto seed = static_cast<uint64_t>(check_integer(L, 1, "seed"));
  const auto item = given(L, 2) ? static_cast<uint64_t>(check_integer(L, 2, "item")) : 0;
  return push_object(L, Random(seed, item));
}

static int uniform(lua_State* L) {
  Random& random = self<Random>(L);
  const double low = given(L, 2) ? check_number(L, 2, "low") : 0;
  const double high = given(L, 3) ? check_number(L, 3, "high") : 1;
  if (!(low <= high)) fail("{}: expected low <= high, got {} and {}", subject(L), low, high);
  return push(L, random.uniform(low, high));
}

// no bias: values beyond the last multiple of the range are redrawn
static int integer(lua_State* L) {
  Random& random = self<Random>(L);
  const int64_t low = check_integer(L, 2, "low"), high = check_integer(L, 3, "high");
  if (low > high) fail("{}: expected low <= high, got {} and {}", subject(L), low, high);
  const uint64_t range =
      static_cast<uint64_t>(high) - static_cast<uint64_t>(low) + 1;  // 0: the complete range
  uint64_t bits = random.bits();
  if (range)
    for (const uint64_t beyond = (0 - range) % range; bits < beyond;) bits = random.bits();
  const uint64_t offset = range ? bits % range : bits;
  lua_pushinteger(L, static_cast<int64_t>(static_cast<uint64_t>(low) + offset));
  return 1;
}

static int direction(lua_State* L) {
  Random& random = self<Random>(L);
  for (;;) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const Eigen::Vector3d v(x, y, z);
    if (v.norm() > 1e-6) return push(L, v.normalized());
  }
}

static int rotation(lua_State* L) {
  Random& random = self<Random>(L);
  for (;;) {
    const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
    const Eigen::Quaterniond q(w, x, y, z);
    if (q.norm() > 1e-6) return push(L, Pose::turn(q.normalized()));
  }
}

static const Entry random_functions[] = {
    {"random", guarded<make_random>, R"(
A stream of random numbers, determined by a seed and the stream's number, and equal on every machine.
@param seed integer  seed of the numbers: the same seed gives the same numbers
@param item? integer  which of many streams, default 0
@return random
@effect reads
> clench.random(1):uniform() == clench.random(1):uniform()  --> true
> clench.random(1, 2):uniform() == clench.random(1, 3):uniform()  --> false)"},
};

static const Entry random_methods[] = {
    {"uniform", guarded<uniform>, R"(
A number from low (included, default 0) to high (excluded, default 1).
@param low? number = 0  lower bound
@param high? number = 1  upper bound
@return number
@effect edits
> x = clench.random(7):uniform(2, 3)
> x >= 2 and x < 3  --> true)"},
    {"normal", method<[](Random& x) { return x.normal(); }>, R"(
A normally distributed number with mean 0 and standard deviation 1.
@return number
@effect edits
> math.abs(clench.random(7):normal()) < 6  --> true)"},
    {"integer", guarded<integer>, R"(
An integer from low to high, both included, uniformly distributed.
@param low integer  smallest result
@param high integer  largest result
@return integer
@effect edits
> clench.random(7):integer(4, 4)  --> 4
> clench.random(7):integer(5, 4)  --> error: expected low <= high, got 5 and 4)"},
    {"direction", guarded<direction>, R"(
A unit vector, uniformly distributed.
@return vec3
@effect edits
> math.abs(clench.random(7):direction():norm() - 1) < 1e-15  --> true)"},
    {"rotation", guarded<rotation>, R"(
A pose at the origin with a uniformly distributed rotation.
@return pose
@effect edits
> clench.random(7):rotation().position  --> (0, 0, 0))"},
};

static const Entry random_operators[] = {
    {"__tostring", method<[](const Random&) { return "random numbers"; }>, ""}};

const Library random_library{.name = "clench", .doc = "", .functions = random_functions};

const Class random_class{.name = "random",
                         .variable = "random",
                         .doc = "A stream of random numbers, made by `clench.random`.",
                         .methods = random_methods,
                         .operators = random_operators};

}  // namespace clench
