#include "clench/high/tall.h"
#include "clench/second.h"
#include <lua.h>
