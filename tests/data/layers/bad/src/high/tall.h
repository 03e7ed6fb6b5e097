#pragma once
#include "low/second.h"
struct lua_State;
class SoSeparator;
struct Solid;
