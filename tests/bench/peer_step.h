// The annealing step built from FCL (collisions of the hand) and Embree (nearest points of the
// object): the same random numbers, rules and energy, so that it visits the same states as Clench.
#pragma once
#include <memory>

#include "clench/planning/energy/contact_sites.h"
#include "clench/planning/search/annealing.h"

namespace clench::bench {

class PeerStep {
 public:
  virtual ~PeerStep() = default;
  /// Takes `count` steps that have a collision-free neighbor.
  virtual void run(int count) = 0;
  virtual double energy() const = 0;
  virtual const Values& values() const = 0;
};

/// plain: tests every pair of bodies with overlapping spheres, in creation order, up to the first
/// collision, and evaluates all sites.
/// tuned: like Clench apart from the queries: tests the pair that collided last first, and
/// evaluates no more of the sum than needed.
enum class PeerKind { plain, tuned };

/// null if this program was built without one of the libraries
std::unique_ptr<PeerStep> peer_step(World& world, const HandAndObject& who,
                                    const SearchSpace& space, uint64_t seed, PeerKind kind);

}  // namespace clench::bench
