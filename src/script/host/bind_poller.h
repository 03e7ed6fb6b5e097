// Natives of the standard library for its event loop.
#pragma once

struct lua_State;

namespace clench {

int new_poller(lua_State* L);

/// Pushes true if a job that the state has started is not over.
int has_jobs(lua_State* L);

}  // namespace clench
