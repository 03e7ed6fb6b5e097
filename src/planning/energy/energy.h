// Objective functions and constraints of grasp searches: numbers that depend on the present state
// of hand and object.
#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "clench/model/world.h"

namespace clench {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// The hand and the object of an energy, in a world or any of its clones.
struct HandAndObject {
  Id<Robot> hand;
  Id<Body> object;
};

/// Lengths are in millimeters here, as in the energies of GraspIt!, so that its numbers, weights
/// and temperatures remain valid.
inline constexpr double energy_length = 1e3;

/// A term of an energy, or a tree of them. It caches data of the last query, which does not affect
/// results; each thread has its own copy.
class Energy {
 public:
  virtual ~Energy() = default;
  /// Exact if it is at most the bound; otherwise any value above it, faster. The world is restored
  /// on return.
  double value(World& world, double bound = infinite) { return bounded_value(world, bound); }
  /// Lower bound over all states; -infinite: unknown.
  virtual double lower_bound() const { return -infinite; }
  virtual std::unique_ptr<Energy> clone() const = 0;
  /// May any thread evaluate it? A script's function may be called only by the script's thread.
  virtual bool any_thread() const { return true; }

 private:
  virtual double bounded_value(World& world, double bound) = 0;
};

using EnergyPtr = std::unique_ptr<Energy>;

/// The weighted sum of terms, with weights >= 0.
class EnergySum : public Energy {
 public:
  struct Term {
    double weight = 1;
    EnergyPtr energy;
  };
  /// throws  Error for a weight that is not finite or negative
  explicit EnergySum(std::vector<Term> terms);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override;
  EnergyPtr clone() const override;
  bool any_thread() const override;

 private:
  std::vector<Term> terms_;
};

/// A term clamped to [low, high].
class EnergyWithin : public Energy {
 public:
  /// throws  Error if low exceeds high, or one is NaN
  EnergyWithin(EnergyPtr energy, double low, double high);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return std::max(low_, energy_->lower_bound()); }
  EnergyPtr clone() const override;
  bool any_thread() const override { return energy_->any_thread(); }

 private:
  EnergyPtr energy_;
  double low_, high_;
};

/// A stateless function of the world, >= 0: any thread may use copies of it.
class PlainEnergy : public Energy {
 public:
  using Function = std::function<double(World&)>;
  explicit PlainEnergy(Function function) : function_(std::move(function)) {}
  double bounded_value(World& world, double) override { return function_(world); }
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<PlainEnergy>(*this); }

 private:
  Function function_;
};

/// A function as a term, for example a script's.
/// throws   what the function throws, and Error if it returns a value that is not a number
class EnergyFunction : public Energy {
 public:
  explicit EnergyFunction(std::function<double()> function) : function_(std::move(function)) {}
  double bounded_value(World& world, double bound) override;
  EnergyPtr clone() const override { return std::make_unique<EnergyFunction>(function_); }
  bool any_thread() const override { return false; }

 private:
  std::function<double()> function_;
};

}  // namespace clench
