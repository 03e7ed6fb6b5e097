// Broad phase: bodies of a world that are near each other, by a sweep over their boxes, then by
// their spheres.
// source  Cohen, Lin, Manocha & Ponamgi (1995), I-COLLIDE: sweep and prune
#pragma once
#include <span>
#include <vector>

#include "clench/base/function_ref.h"
#include "clench/model/world.h"

namespace clench {

/// Lower bound on the distance of two bodies with geometry, from their bounding spheres; negative
/// if these overlap [m].
double sphere_gap(const World& world, Id<Body> a, Id<Body> b);

/// Pairs of the world that may collide and may be within reach [m]: the earlier body first, in
/// creation order. Complete: no pair within reach is missing.
std::vector<BodyPair> near_bodies(const World& world, double reach, QueryContext& context);

/// One of each group, each pair once, in the groups' order.
std::vector<BodyPair> near_bodies(const World& world, std::span<const Id<Body>> a,
                                  std::span<const Id<Body>> b, double reach, QueryContext& context);

/// Is there a pair of bodies near enough to touch for which collides(pair, its memory) is true?
/// Pairs that often collided recently are tested first, and the search ends at the first that does.
bool any_near(const World& world, QueryContext& context,
              FunctionRef<bool(const BodyPair&, PairCache&)> collides);

/// The first `max` pairs, in creation order, near enough to touch for which collides(pair) is true.
std::vector<BodyPair> first_near(const World& world, size_t max, QueryContext& context,
                                 FunctionRef<bool(const BodyPair&)> collides);

/// b in the frame of a.
Pose relative_pose(const World& world, Id<Body> a, Id<Body> b);

}  // namespace clench
