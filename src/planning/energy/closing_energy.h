// Energies of the grasp that a hand has once it has closed from where it stands.
#pragma once
#include "clench/grasp/wrench/grasp.h"
#include "clench/planning/energy/contact_energy.h"

namespace clench {

/// Minus what the closed grasp is worth: volume_weight * volume + epsilon_weight * epsilon, and
/// task_weight times the largest multiple of all task wrenches that it resists. `nothing` where all
/// of them are 0.
class ClosingEnergy : public Energy {
 public:
  struct Options {
    double volume_weight = 30, epsilon_weight = 100, task_weight = 0;  ///< >= 0
    double nothing = 0;
    /// before it closes, the hand goes so far along its approach direction, until it touches [m]
    double approach = 0;
    bool palm = false;  ///< it goes only where its base then touches something
    /// on the object from outside, in its axes, torque about its centre of mass [N, N m]
    std::vector<Vector6d> tasks = {};
    GraspOptions grasp = {};
  };
  /// throws  Error when an option is out of range
  ClosingEnergy(const HandAndObject& who, const Options& options);
  double bounded_value(World& world, double bound) override;
  EnergyPtr clone() const override { return std::make_unique<ClosingEnergy>(*this); }

 private:
  double worth(const World& world) const;

  HandAndObject who_;
  Options options_;
};

/// A contact energy, and where two sites are near and face the object, less what the closed grasp
/// is worth.
class GuidedClosingEnergy : public Energy {
 public:
  struct Options {
    SiteKind contacts = SiteKind::preset;
    Facing facing = Facing::nearest;
    double near = 0.02;       ///< such a site is no farther [m]
    double min_facing = 0.7;  ///< and this is its cosine at least
    double volume_weight = 1000;
    int min_contacts = 4;  ///< that a closed grasp needs to count
  };
  GuidedClosingEnergy(const World& world, const HandAndObject& who, const Options& options);
  double bounded_value(World& world, double bound) override;
  EnergyPtr clone() const override { return std::make_unique<GuidedClosingEnergy>(*this); }

 private:
  ContactEnergy contact_;
  Options options_;
};

/// Of hands with springs: closes on the object from its first touch along the approach direction,
/// and asks whether the contacts balance the joints at full effort. -200 + the unbalanced force [N]
/// where they do; 1 where they do not, where fewer than two touch, or where epsilon is below
/// min_epsilon.
class CompliantEnergy : public Energy {
 public:
  struct Options {
    double approach = 0.2;  ///< at most so far to the first touch [m]
    double min_epsilon = 0.05;
  };
  CompliantEnergy(const HandAndObject& who, const Options& options)
      : who_(who), options_(options) {}
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return -200; }
  EnergyPtr clone() const override { return std::make_unique<CompliantEnergy>(*this); }

 private:
  HandAndObject who_;
  Options options_;
};

}  // namespace clench
