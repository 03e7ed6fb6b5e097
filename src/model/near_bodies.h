// Which bodies of a world are near enough to be looked at: a sweep over their boxes, then their
// spheres.
// source  Cohen, Lin, Manocha & Ponamgi (1995), I-COLLIDE: sweep and prune
#pragma once
#include <span>
#include <vector>

#include "clench/base/function_ref.h"
#include "clench/model/world.h"

namespace clench {

/// Least distance that the bounding spheres of two bodies with geometry allow; negative when they
/// overlap [m].
double sphere_gap(const World& world, Id<Body> a, Id<Body> b);

/// Pairs of the world that may collide and may be as near as reach [m]: the earlier body first, in
/// creation order. None that is as near is missing.
std::vector<BodyPair> near_bodies(const World& world, double reach, QueryContext& context);

/// One of each group, each pair once, in the groups' order.
std::vector<BodyPair> near_bodies(const World& world, std::span<const Id<Body>> a,
                                  std::span<const Id<Body>> b, double reach, QueryContext& context);

/// Is there a pair of bodies near enough to touch for which collides(pair, its memory) is true?
/// Pairs that collided often of late are asked first, and when one does, no others are looked for.
bool any_near(const World& world, QueryContext& context,
              FunctionRef<bool(const BodyPair&, PairCache&)> collides);

/// The first `max` pairs, in creation order, near enough to touch for which collides(pair) is true.
std::vector<BodyPair> first_near(const World& world, size_t max, QueryContext& context,
                                 FunctionRef<bool(const BodyPair&)> collides);

/// b in the frame of a.
Pose relative_pose(const World& world, Id<Body> a, Id<Body> b);

}  // namespace clench
