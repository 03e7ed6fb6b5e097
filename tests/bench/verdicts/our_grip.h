// A grip in Clench's engine, with the same convex pieces as in the other engines.
#pragma once
#include <memory>

#include "bench/verdicts/grip_test.h"

namespace clench::bench {

/// Steps of 1 ms, contacts within 0.1 mm, full friction; servos are critically damped for the
/// inertia of their joint.
std::unique_ptr<Grip> our_grip(const GripScene& scene, const StoredGrasp& grasp,
                               const GripOptions& options);

}  // namespace clench::bench
