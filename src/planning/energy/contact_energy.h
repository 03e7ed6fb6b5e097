// Energies of contact sites: their distances and angles to the object, without closing the hand.
// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping, sec. 5
#pragma once
#include "clench/planning/energy/contact_sites.h"

namespace clench {

/// Direction with which a site's normal is compared.
enum class Facing {
  nearest,  ///< the direction to the nearest point
  surface,  ///< the inward normal of the surface there
  /// the direction from the nearest point back: the sign of GraspIt!'s GUIDED_AUTO_GRASP_QUALITY
  away,
};

/// Mean over the sites of distance + weight * (1 - cosine of the angle), the distance in mm.
class ContactEnergy : public Energy {
 public:
  struct Options {
    SiteKind contacts = SiteKind::preset;
    double normal_weight = 50;  ///< >= 0 [mm]
    Facing facing = Facing::nearest;
  };
  /// throws  Error as ContactSites, or for a weight that is not finite or negative
  ContactEnergy(const World& world, const HandAndObject& who, const Options& options);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<ContactEnergy>(*this); }

  /// Pose of a site relative to the object, and the cosine in use.
  struct SiteTerm {
    SiteDistance at;
    double cosine = 0;
  };
  SiteTerm measure(World& world, int i);
  double of(const SiteTerm& term) const;  ///< [mm]
  ContactSites& sites() { return sites_; }

 private:
  ContactSites sites_;
  Options options_;
  std::vector<double> min_rest_;  ///< lower bound of the sum of the terms from each on
};

/// Potential quality of the sites if they touched: each has the weight (cos(pi d / reach) + 1) if
/// it faces the object and is within reach. Minus epsilon of the forces that they exert; 1 if these
/// do not surround the origin.
class PotentialQuality : public Energy {
 public:
  struct Options {
    SiteKind contacts = SiteKind::preset;
    double reach = 0.05;      ///< > 0 [m]
    double min_facing = 0.7;  ///< cosine of the largest angle
    double min_share = 0.25;  ///< of a site that is used
    int min_count = 3;        ///< number of them
    bool torques = false;     ///< wrenches, not only forces
  };
  /// throws  Error as ContactSites, or if an option is out of range
  PotentialQuality(const World& world, const HandAndObject& who, const Options& options);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override;
  EnergyPtr clone() const override { return std::make_unique<PotentialQuality>(*this); }

 private:
  ContactSites sites_;
  Options options_;
};

/// The first if it is at most 0, otherwise the second: one that guides the search to where the
/// first is meaningful.
class GuidedEnergy : public Energy {
 public:
  GuidedEnergy(EnergyPtr first, EnergyPtr second)
      : first_(std::move(first)), second_(std::move(second)) {}
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override {
    return std::min(first_->lower_bound(), second_->lower_bound());
  }
  EnergyPtr clone() const override {
    return std::make_unique<GuidedEnergy>(first_->clone(), second_->clone());
  }
  bool any_thread() const override { return first_->any_thread() && second_->any_thread(); }

 private:
  EnergyPtr first_, second_;
};

}  // namespace clench
