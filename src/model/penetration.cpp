#include "clench/model/penetration.h"

#include <limits>

#include "clench/model/near_bodies.h"

namespace clench {

// depth of one body in another, with the point in the world frame
static BodyPenetration pair_penetration(const World& world, Id<Body> body, Id<Body> other,
                                        const PenetrationOptions& options) {
  const Shape &mine = *world.body(body).shape, &theirs = *world.body(other).shape;
  if (!mine.closed() && !theirs.closed()) {
    const Distance found = distance(theirs, mine, relative_pose(world, other, body), 0);
    if (found.distance > 0) return {};
    return {std::numeric_limits<double>::infinity(), world.pose(other) * found.p_a, body, other};
  }
  const Id<Body> solid = theirs.closed() ? other : body, guest = theirs.closed() ? body : other;
  const Penetration found = penetration(*world.body(solid).shape, *world.body(guest).shape,
                                        relative_pose(world, solid, guest), options);
  return {found.depth, world.pose(solid) * found.point, body, other};
}

BodyPenetration penetration(const World& world, std::span<const Id<Body>> a,
                            std::span<const Id<Body>> b, const PenetrationOptions& options) {
  BodyPenetration deepest;
  for (const Id<Body> body : a)
    for (const Id<Body> other : b) {
      if (body == other || !world.body(body).shape || !world.body(other).shape ||
          sphere_gap(world, body, other) > 0)
        continue;
      options.progress.check();
      const BodyPenetration found = pair_penetration(world, body, other, options);
      if (found.depth > deepest.depth) deepest = found;
    }
  return deepest;
}

}  // namespace clench
