// The annealing step made from FCL (does the hand collide?) and Embree (the object's nearest
// points): the same random draws, the same rules, the same energy, so that it goes where ours goes.
#pragma once
#include <memory>

#include "clench/planning/energy/contact_sites.h"
#include "clench/planning/search/annealing.h"

namespace clench::bench {

class PeerStep {
 public:
  virtual ~PeerStep() = default;
  /// Takes so many steps with a legal neighbor.
  virtual void run(int count) = 0;
  virtual double energy() const = 0;
  virtual const Values& values() const = 0;
};

/// plain: every pair of bodies whose spheres meet, in creation order, up to the first that
/// collides, and all sites.
/// tuned: with what ours has besides faster queries: the pair that collided last first, and no more
/// of the sum than is needed.
enum class PeerKind { plain, tuned };

/// null: this program was built without one of them
std::unique_ptr<PeerStep> peer_step(World& world, const HandAndObject& who,
                                    const SearchSpace& space, uint64_t seed, PeerKind kind);

}  // namespace clench::bench
