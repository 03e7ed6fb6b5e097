#include "bench/peer_step.h"

#include <cmath>

#include "bench/peers.h"
#include "clench/model/near_bodies.h"

namespace clench::bench {

#if defined(CLENCH_BENCH_FCL) && defined(CLENCH_BENCH_EMBREE)

namespace {

class FclEmbreeStep : public PeerStep {
 public:
  FclEmbreeStep(World& world, const HandAndObject& who, const SearchSpace& space, uint64_t seed,
                PeerKind kind)
      : tuned_(kind == PeerKind::tuned),
        world_(world),
        who_(who),
        space_(space),
        random_(seed),
        sites_(world, who, SiteKind::preset),
        points_(embree_point(*world.body(who.object).shape)),
        values_(space.start()),
        k_(schedule_.first_step) {
    const auto parts = world.bodies_of(who.hand);
    const auto is_part = [&](Id<Body> body) {
      return std::ranges::find(parts, body) != parts.end();
    };
    for (const auto part : parts)
      for (const auto other : world.bodies()) {
        const bool once = !is_part(other) || part < other;
        if (once && world.may_collide(part, other) && world.body(part).shape &&
            world.body(other).shape)
          pairs_.push_back(
              {part, other, fcl_pair(*world.body(part).shape, *world.body(other).shape)});
      }
    energy_ = place(space_.state(values_)) ? value(infinite) : infinite;
  }

  void run(int count) override {
    for (int taken = 0; taken < count;) taken += step();
  }
  double energy() const override { return energy_; }
  const Values& values() const override { return values_; }

 private:
  struct Pair {
    Id<Body> a, b;
    std::unique_ptr<PairPeer> peer;
  };

  bool place(const HandState& state) {
    world_.set_posture(who_.hand, world_.pose(who_.object) * state.X_RH, state.dofs);
    for (size_t i = 0; i < pairs_.size(); ++i) {
      Pair& pair = pairs_[i];
      if (sphere_gap(world_, pair.a, pair.b) > 0) continue;
      if (*pair.peer->collide(world_.pose(pair.a).inverse() * world_.pose(pair.b))) {
        // the pair that collided last is tested first
        if (tuned_)
          std::rotate(pairs_.begin(), pairs_.begin() + std::ptrdiff_t(i),
                      pairs_.begin() + std::ptrdiff_t(i) + 1);
        return false;
      }
    }
    return true;
  }

  double value(double bound) {
    const Pose X_OW = world_.pose(who_.object).inverse();
    const double enough = !tuned_ ? infinite : bound * sites_.size() + 1e-9 * sites_.size();
    double sum = 0;
    for (int i = 0; i < sites_.size() && !(sum > enough); ++i) {
      const ContactSite& site = sites_.site(i);
      const Pose X_OC = X_OW * world_.pose(site.body) * site.X_LC;
      const Eigen::Vector3d q = *points_->nearest(X_OC.position),
                            n = X_OC.rotation * Eigen::Vector3d::UnitZ();
      const double distance = (q - X_OC.position).norm();
      const double cosine = distance > 0 ? n.dot(q - X_OC.position) / distance : 1;
      sum += energy_length * distance + 50 * (1 - cosine);
    }
    return sum / sites_.size();
  }

  bool step() {
    const double warm = schedule_.neighbor_scale * schedule_.neighbor_temperature(double(k_));
    Values next;
    bool legal = false;
    for (int i = 0; i < 11 && !legal; ++i) {
      next = values_;
      for (int v = 0; v < next.size(); ++v) {
        const Variable& variable = space_.variables()[v];
        if (variable.fixed) continue;
        do {
          const double x = 2 * random_.uniform() - 1;
          next[v] =
              values_[v] +
              variable.jump * std::copysign(warm * (std::pow(1 + 1 / warm, std::abs(x)) - 1), x);
          const double range = variable.max - variable.min;
          if (variable.circular && next[v] > variable.max) next[v] -= range;
          if (variable.circular && next[v] < variable.min) next[v] += range;
        } while (!(next[v] >= variable.min && next[v] <= variable.max));
      }
      legal = place(space_.state(next));
    }
    if (!legal) return false;
    const double warmth = schedule_.error_temperature(double(k_)) / schedule_.error_scale;
    const double bound = energy_ - warmth * std::log(1 - random_.uniform());
    const double energy = value(bound);
    ++k_;
    if (energy <= bound) {
      values_ = next;
      energy_ = energy;
    }
    return true;
  }

  bool tuned_;
  World& world_;
  HandAndObject who_;
  SearchSpace space_;
  AnnealingSchedule schedule_;
  Random random_;
  ContactSites sites_;
  std::unique_ptr<PointPeer> points_;
  std::vector<Pair> pairs_;
  Values values_;
  double energy_ = 0;
  int64_t k_;
};

}  // namespace

std::unique_ptr<PeerStep> peer_step(World& world, const HandAndObject& who,
                                    const SearchSpace& space, uint64_t seed, PeerKind kind) {
  return std::make_unique<FclEmbreeStep>(world, who, space, seed, kind);
}

#else

std::unique_ptr<PeerStep> peer_step(World&, const HandAndObject&, const SearchSpace&, uint64_t,
                                    PeerKind) {
  return nullptr;
}

#endif

}  // namespace clench::bench
