// Natives of the standard library for ports (stdlib/port).
#pragma once

struct lua_State;

namespace clench {

int open_serial_stream(lua_State* L);
int open_pty_stream(lua_State* L);
int open_stream_pair(lua_State* L);
int open_stdio_stream(lua_State* L);
int begin_stream(lua_State* L);
int open_acceptor(lua_State* L);
int resolve_host(lua_State* L);
int save_secret(lua_State* L);
int canonical_path(lua_State* L);

}  // namespace clench
