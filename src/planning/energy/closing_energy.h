// Energies of the grasp that results from closing the hand in its present pose.
#pragma once
#include "clench/grasp/wrench/grasp.h"
#include "clench/planning/energy/contact_energy.h"

namespace clench {

/// Negative quality of the closed grasp: volume_weight * volume + epsilon_weight * epsilon, plus
/// task_weight times the largest multiple of all task wrenches that it resists. `nothing` if all of
/// them are 0.
class ClosingEnergy : public Energy {
 public:
  struct Options {
    double volume_weight = 30, epsilon_weight = 100, task_weight = 0;  ///< >= 0
    double nothing = 0;
    /// before closing, the hand moves this far along its approach direction, or until it touches
    /// [m]
    double approach = 0;
    bool palm = false;  ///< it moves only if its base then touches something
    /// external wrenches on the object, in its axes, torque about its center of mass [N, N m]
    std::vector<Vector6d> tasks = {};
    GraspOptions grasp = {};
  };
  /// throws  Error if an option is out of range
  ClosingEnergy(const HandAndObject& who, const Options& options);
  double bounded_value(World& world, double bound) override;
  EnergyPtr clone() const override { return std::make_unique<ClosingEnergy>(*this); }

 private:
  double worth(const World& world) const;

  HandAndObject who_;
  Options options_;
};

/// A contact energy, and if two sites are near and face the object, minus the quality of the closed
/// grasp.
class GuidedClosingEnergy : public Energy {
 public:
  struct Options {
    SiteKind contacts = SiteKind::preset;
    Facing facing = Facing::nearest;
    double near = 0.02;       ///< largest distance of such a site
    double min_facing = 0.7;  ///< and its smallest cosine
    double volume_weight = 1000;
    int min_contacts = 4;  ///< minimum quality of a closed grasp that counts
  };
  GuidedClosingEnergy(const World& world, const HandAndObject& who, const Options& options);
  double bounded_value(World& world, double bound) override;
  EnergyPtr clone() const override { return std::make_unique<GuidedClosingEnergy>(*this); }

 private:
  ContactEnergy contact_;
  Options options_;
};

/// For hands with springs: closes on the object from its first touch along the approach direction,
/// and tests whether the contacts balance the joints at full effort. -200 + the unbalanced force
/// [N] if they do; 1 if they do not, if fewer than two touch, or if epsilon is below min_epsilon.
class CompliantEnergy : public Energy {
 public:
  struct Options {
    double approach = 0.2;  ///< largest travel to the first touch [m]
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
