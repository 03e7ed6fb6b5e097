#include "clench/grasp/measure/clearance.h"

#include "clench/model/penetration.h"

namespace clench {

double clearance(const World& world, Id<Robot> hand, Id<Body> object) {
  std::vector<Id<Body>> others;
  for (const Id<Body> id : world.bodies()) {
    const BodyKind kind = world.body(id).kind;
    if (id != object && (kind == BodyKind::object || kind == BodyKind::obstacle))
      others.push_back(id);
  }
  const auto parts = world.bodies_of(hand);
  return distance(world, parts, others).distance;
}

double penetration(const World& world, Id<Robot> hand, Id<Body> object, const Progress& progress) {
  return penetration(world, world.bodies_of(hand), std::span(&object, 1), {.progress = progress})
      .depth;
}

}  // namespace clench
