// A native of the standard library: what its event loop waits by.
#pragma once

struct lua_State;

namespace clench {

int new_poller(lua_State* L);

/// Does a job run that the state has started?   returns  on the stack
int has_jobs(lua_State* L);

}  // namespace clench
