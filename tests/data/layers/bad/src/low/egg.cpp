#include "clench/low/egg.h"
#include "clench/low/hen.h"

static constexpr int feathers = 0;
