// Contacts of balls, which roll: a mesh that is a tessellation of a ball touches as the ball
// itself.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Is one of the pair a ball?
bool has_ball(const World& world, const Manifold& manifold);

/// Distance of the ball and the other body where they are, as of their surfaces; negative where
/// they overlap [m].
/// limit  what is farther is `limit` [m]
double ball_distance(const World& world, const Manifold& manifold, double limit);

/// Points at which they touch: one for each part of the other surface that is nearest to the ball's
/// centre from its side.
std::vector<ManifoldPoint> ball_points(const World& world, const Manifold& manifold,
                                       double threshold);

}  // namespace clench
