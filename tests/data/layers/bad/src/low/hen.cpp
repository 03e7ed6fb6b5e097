#include "clench/low/egg.h"

static constexpr int feathers = 3;
