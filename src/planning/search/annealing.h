// Simulated annealing of a hand about an object: one chain, step by step.
// source  Ingber (1989), Very fast simulated re-annealing; Ciocarlie & Allen (2009), sec. 5
#pragma once
#include <optional>

#include "clench/base/progress.h"
#include "clench/base/random.h"
#include "clench/planning/energy/energy.h"
#include "clench/planning/search/best_list.h"

namespace clench {

/// Temperatures at step k: t0 exp(-decay k^(1 / dimensions)).
struct AnnealingSchedule {
  double neighbor_decay = 7, error_decay = 7;
  double neighbor_dimensions = 8, error_dimensions = 8;
  double neighbor_scale = 1;  ///< of the temperature of neighbors
  double error_scale = 1e-6;  ///< of energies
  double t0 = 1e6;
  int first_step = 30000;  ///< k of the first step

  double neighbor_temperature(double step) const;
  double error_temperature(double step) const;
};

/// "default", "loop", "modified", "strict", "online".
/// throws Error that suggests the nearest name
AnnealingSchedule annealing_schedule(const std::string& name);

struct AnnealingOptions {
  AnnealingSchedule schedule = {};
  uint64_t seed = 0;
  int max_tries = 11;      ///< tries of neighbors until one is legal, >= 1
  bool collisions = true;  ///< is a colliding hand illegal?
  BestListOptions best = {};
};

/// Statistics of the steps.
struct AnnealingCounts {
  int64_t steps = 0;  ///< with a legal neighbor
  int64_t accepted = 0;
  int64_t improved = 0;      ///< accepted ones that lowered the energy
  int64_t stuck = 0;         ///< tries without a legal neighbor; they do not count as steps
  int64_t in_collision = 0;  ///< neighbors
  int64_t avoided = 0;       ///< neighbors rejected because of the avoid list
  int64_t outside = 0;  ///< neighbors for which 100 draws did not bring a variable into its range
};

/// A chain in its own world, one per thread. It has a present state, and keeps the best states in
/// its list.
class Annealing {
 public:
  /// world   every step moves the hand; the hand must not be carried
  /// throws  Error if an option is out of range or the hand is carried
  Annealing(World& world, const HandAndObject& who, SearchSpace space, EnergyPtr energy,
            const AnnealingOptions& options = {});

  /// Takes `count` more steps with a legal neighbor.
  /// returns  fewer if 10,000 consecutive tries found none
  /// throws   Stopped, between two steps, and what an energy throws
  int run(int count, const Progress& progress = {});

  const SearchSpace& space() const { return space_; }
  const Values& values() const { return values_; }
  double energy() const { return energy_value_; }
  double first_energy() const { return first_energy_; }
  const AnnealingCounts& counts() const { return counts_; }
  BestList& best() { return best_; }
  const BestList& best() const { return best_; }
  int64_t step() const { return k_; }  ///< of the schedule
  /// Restarts the schedule; the state is unchanged.
  void reset_schedule() { k_ = options_.schedule.first_step; }
  /// Sets the state.
  /// throws Error as SearchSpace::state
  void go_to(const Values& values);
  bool any_thread() const { return energy_->any_thread(); }
  World& world() const { return world_; }
  const HandAndObject& who() const { return who_; }

 private:
  enum class Verdict { legal, collides, avoided };
  std::optional<Values> neighbor();
  double jump(const Variable& variable, double value, double temperature, double reach);
  Verdict place(const HandState& state);
  bool take_step();

  World& world_;
  HandAndObject who_;
  SearchSpace space_;
  EnergyPtr energy_;
  AnnealingOptions options_;
  Random random_;
  BestList best_;
  AnnealingCounts counts_;
  Values values_;
  std::vector<Id<Body>> parts_;
  double energy_value_ = 0, first_energy_ = 0;
  int64_t k_ = 0;
};

}  // namespace clench
