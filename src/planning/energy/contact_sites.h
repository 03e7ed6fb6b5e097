// Places of a hand that should touch, and how they lie to an object.
#pragma once
#include <vector>

#include "clench/planning/energy/energy.h"
#include "clench/spec/virtual_contact_spec.h"

namespace clench {

enum class SiteKind {
  preset,  ///< the hand's virtual contacts; those that are found for a hand that brings none
  live,    ///< of base and each link with geometry the point nearest to the object
};

struct ContactSite {
  Id<Body> body;
  Pose X_LC;  ///< contact frame in the body, +z outward; of live ones not known
  double mu = 1;
  FrictionEdges edges;
  Eigen::Vector3d n_L = Eigen::Vector3d::UnitZ();  ///< z of the contact frame in the body
};

/// How a site lies to the object, in the object's frame.
struct SiteDistance {
  Eigen::Vector3d p, n;  ///< where it is, and its outward normal
  Eigen::Vector3d q;     ///< the nearest point of the object
  Eigen::Vector3d u;     ///< unit, from p to q; the normal where they are one
  int triangle = -1;     ///< of the object, that q lies on
  double distance = 0;   ///< [m]

  /// of the angle between the normal and the way to the object
  double facing() const { return n.dot(u); }
};

class ContactSites {
 public:
  /// Preset ones are those that the hand has now.
  /// throws  Error when the object has no geometry or is a part of the hand, or there are no sites
  ContactSites(const World& world, const HandAndObject& who, SiteKind kind);

  int size() const { return static_cast<int>(sites_.size()); }
  const ContactSite& site(int i) const { return sites_[i]; }
  const HandAndObject& who() const { return who_; }
  /// Sees where the object and the sites are now; then measure() says how they lie to each other.
  void attend(const World& world);
  /// world  as it was attended to
  SiteDistance measure(World& world, int i);
  /// No more than measure() finds, and found sooner [m].
  double min_distance(const World& world, int i) const;

 private:
  SiteDistance measure_live(World& world, int i);

  /// Of a preset site.
  struct Place {
    Eigen::Vector3d p_O;
    int triangle = -1;  ///< of the object, where it was nearest last
  };
  HandAndObject who_;
  SiteKind kind_;
  std::vector<ContactSite> sites_;
  std::vector<Place> places_;
  Pose X_OW_;
};

}  // namespace clench
