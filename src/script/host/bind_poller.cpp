// clench.poller: descriptors and timer of stdlib/loop.lua.
#include "clench/script/host/bind_poller.h"

#include <algorithm>

#include "clench/script/host/poller.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/watching.h"

namespace clench {

namespace {

using PollerPtr = std::shared_ptr<Poller>;

// poller:watch(descriptor, readable, writable)
int watch(lua_State* L) {
  const int64_t descriptor = check_integer(L, 2, "descriptor");
  if (descriptor < 0 || descriptor > 1'000'000)
    fail("clench.loop: expected a descriptor >= 0, got {}", descriptor);
  self<PollerPtr>(L)->watch(static_cast<int>(descriptor), lua_toboolean(L, 3), lua_toboolean(L, 4));
  return 0;
}

// poller:set_timer(seconds)
int set_timer(lua_State* L) {
  self<PollerPtr>(L)->set_timer(check_number(L, 2, "seconds"));
  return 0;
}

// poller:wait(seconds): descriptors that are ready, each followed by "readable" or "writable".
// Returns after at most 0.1 s; Ctrl-C raises an error.
int wait(lua_State* L) {
  constexpr double piece = 0.1;
  const Watching watching(L);
  const double seconds = check_number(L, 2, "seconds");
  const auto ready = self<PollerPtr>(L)->wait(seconds < 0 ? piece : std::min(seconds, piece));
  watching.progress().check();
  push_list(L, 2 * static_cast<int>(ready.size()));
  lua_Integer i = 0;
  for (const Poller::Ready& item : ready) {
    lua_pushinteger(L, item.descriptor);
    lua_rawseti(L, -2, ++i);
    push(L, item.event == Poller::Event::readable ? "readable" : "writable");
    lua_rawseti(L, -2, ++i);
  }
  return 1;
}

int get_descriptor(lua_State* L) { return push(L, self<PollerPtr>(L)->descriptor()); }

const Entry poller_methods[] = {
    {"watch", guarded<watch>,
     "\n@param descriptor integer\n@param readable boolean\n@param writable boolean"},
    {"set_timer", guarded<set_timer>, "\n@param seconds number"},
    {"wait", guarded<wait>, "\n@param seconds number"},
    {"descriptor", guarded<get_descriptor>, ""}};
const Class poller_class{
    .name = "poller", .variable = "poller", .doc = "", .methods = poller_methods};

}  // namespace

template <>
inline constexpr const Class* script_class<PollerPtr> = &poller_class;

int new_poller(lua_State* L) { return push_object(L, std::make_shared<Poller>(bell_of(L))); }

}  // namespace clench
