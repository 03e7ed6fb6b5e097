#pragma once
#include "clench/low/second.h"
struct lua_State;
class SoSeparator;
struct Solid;
