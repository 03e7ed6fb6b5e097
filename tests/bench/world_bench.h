// Colliding pairs of worlds with many bodies: cost of the broad phase as they grow.
#pragma once
#include "bench/report.h"

namespace clench::bench {

/// boxes as dense as gravel, from 10 to `most`; small numbers are compared with all pairs
void measure_worlds(int most, Report& report);

}  // namespace clench::bench
