// A grip in our own engine, on the same convex pieces that the others have.
#pragma once
#include <memory>

#include "bench/verdicts/grip_test.h"

namespace clench::bench {

/// Steps of 1 ms, contacts within 0.1 mm, all of the friction; servos are critically damped for the
/// inertia of their joint.
std::unique_ptr<Grip> our_grip(const GripScene& scene, const StoredGrasp& grasp,
                               const GripOptions& options);

}  // namespace clench::bench
