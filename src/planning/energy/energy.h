// What a search makes small: a number for how a hand stands to an object now.
#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "clench/model/world.h"

namespace clench {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// The hand and the object that an energy is about, in a world or any of its clones.
struct HandAndObject {
  Id<Robot> hand;
  Id<Body> object;
};

/// Lengths count in millimetres here, as in the energies of GraspIt!, so that its numbers, weights
/// and temperatures hold.
inline constexpr double energy_length = 1e3;

/// A term of an energy, or a tree of them. It remembers where it looked last, which changes no bit
/// of an answer; each thread has a copy of its own.
class Energy {
 public:
  virtual ~Energy() = default;
  /// Exact where it is at most the bound; otherwise anything above it, found sooner. The world
  /// stands on return as it did.
  double value(World& world, double bound = infinite) { return bounded_value(world, bound); }
  /// No state has less; -infinite: not known.
  virtual double lower_bound() const { return -infinite; }
  virtual std::unique_ptr<Energy> clone() const = 0;
  /// May any thread ask it? A script's function may be asked by the script's thread alone.
  virtual bool any_thread() const { return true; }

 private:
  virtual double bounded_value(World& world, double bound) = 0;
};

using EnergyPtr = std::unique_ptr<Energy>;

/// The sum of terms, each times a weight >= 0.
class EnergySum : public Energy {
 public:
  struct Term {
    double weight = 1;
    EnergyPtr energy;
  };
  /// throws  Error for a weight that is not finite or below 0
  explicit EnergySum(std::vector<Term> terms);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override;
  EnergyPtr clone() const override;
  bool any_thread() const override;

 private:
  std::vector<Term> terms_;
};

/// A term kept within [low, high]: below low it counts as low, above high as high.
class EnergyWithin : public Energy {
 public:
  /// throws  Error when low exceeds high, or one is not a number
  EnergyWithin(EnergyPtr energy, double low, double high);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return std::max(low_, energy_->lower_bound()); }
  EnergyPtr clone() const override;
  bool any_thread() const override { return energy_->any_thread(); }

 private:
  EnergyPtr energy_;
  double low_, high_;
};

/// A function of the world, >= 0, that remembers nothing: copies of it are good for any thread.
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

/// A function as a term, a script's for instance.   throws what the function throws, and Error when
/// it gives no number
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
