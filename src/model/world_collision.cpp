// Collision settings of a world.
#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/model/world.h"

namespace clench {

void World::set_collision(bool on) { edit_settings().collision_on = on; }

void World::set_collision(bool on, Id<Body> id) {
  body(id);
  if (on)
    edit_settings().switched_off.erase(id);
  else
    edit_settings().switched_off.insert(id);
}

void World::set_collision(bool on, Id<Body> a, Id<Body> b) {
  body(a), body(b);
  WorldSettings& settings = edit_settings();
  const BodyPair pair = ordered(a, b);
  if (on)
    settings.pairs_off.erase(pair);
  else
    settings.pairs_off.insert(pair);
  if (on && settings.bits_keep_apart(a, b))
    settings.pairs_on.insert(pair);
  else if (!on)
    settings.pairs_on.erase(pair);
}

bool World::may_collide(Id<Body> a, Id<Body> b) const {
  return a != b && body(a).shape && body(b).shape && settings_->may_collide(a, b);
}

void World::set_collision_bits(Id<Body> id, const CollisionBits& bits) {
  const Id<Robot> robot = body(id).robot;
  edit_settings().collision_bits[id] = {bits, robot};
}

std::vector<BodyPair> World::pairs_off() const {
  const auto& bits = settings_->collision_bits;
  std::set<BodyPair> out = settings_->pairs_off;
  for (auto a = bits.begin(); a != bits.end(); ++a) {
    check_stop();
    for (auto b = std::next(a); b != bits.end(); ++b) {
      if (!settings_->bits_keep_apart(a->first, b->first)) continue;
      out.insert(ordered(a->first, b->first));
      if (out.size() > max_pairs_off)
        fail(ErrorKind::limit, "world: expected at most {} pairs of bodies that never collide",
             max_pairs_off);
    }
  }
  return {out.begin(), out.end()};
}

}  // namespace clench
