// Colliding pairs of worlds of many bodies: what the broad phase costs as they grow.
#pragma once
#include "bench/report.h"

namespace clench::bench {

/// boxes as dense as gravel, 10 to `most` of them; all pairs are compared where they are few
void measure_worlds(int most, Report& report);

}  // namespace clench::bench
