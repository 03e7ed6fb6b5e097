#pragma once
#include "clench/low/first.h"
/* a comment may name lua_State, and include what it likes:
#include "clench/high/tall.h"
*/
inline const char* text = "so may a literal: lua_State 'and' \" SoSeparator";
inline const char* raw = R"raw(SoSeparator "lua_State)raw";
inline int large = 1'000'000;
