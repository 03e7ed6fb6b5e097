#pragma once
#include "clench/high/roof/tiles.h"

int climb(int steps);
