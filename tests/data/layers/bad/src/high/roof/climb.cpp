#include "clench/high/cellar/stairs.h"

int climb(int steps) { return steps; }
