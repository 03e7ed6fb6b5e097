#include "high/tall.h"
#include "second.h"
#include <lua.h>
