// Contact sites of a hand, and their poses relative to an object.
#pragma once
#include <vector>

#include "clench/planning/energy/energy.h"
#include "clench/spec/virtual_contact_spec.h"

namespace clench {

enum class SiteKind {
  preset,  ///< the hand's virtual contacts; inferred ones for a hand without
  live,    ///< on the base and each link with geometry, the point nearest to the object
};

struct ContactSite {
  Id<Body> body;
  Pose X_LC;  ///< contact frame in the body, +z outward; unknown for live ones
  double mu = 1;
  FrictionEdges edges;
  Eigen::Vector3d n_L = Eigen::Vector3d::UnitZ();  ///< z of the contact frame in the body
};

/// Pose of a site relative to the object, in the object's frame.
struct SiteDistance {
  Eigen::Vector3d p, n;  ///< its position and outward normal
  Eigen::Vector3d q;     ///< the nearest point of the object
  Eigen::Vector3d u;     ///< unit, from p to q; the normal if they coincide
  int triangle = -1;     ///< of the object, contains q
  double distance = 0;   ///< [m]

  /// cosine of the angle between the normal and the direction to the object
  double facing() const { return n.dot(u); }
};

class ContactSites {
 public:
  /// Preset sites are those that the hand has at this time.
  /// throws  Error if the object has no geometry or is a part of the hand, or there are no sites
  ContactSites(const World& world, const HandAndObject& who, SiteKind kind);

  int size() const { return static_cast<int>(sites_.size()); }
  const ContactSite& site(int i) const { return sites_[i]; }
  const HandAndObject& who() const { return who_; }
  /// Updates the poses of the object and the sites; then measure() returns their relation.
  void attend(const World& world);
  /// world  as passed to attend()
  SiteDistance measure(World& world, int i);
  /// A lower bound of the distance that measure() returns, faster [m].
  double min_distance(const World& world, int i) const;

 private:
  SiteDistance measure_live(World& world, int i);

  /// For a preset site.
  struct Place {
    Eigen::Vector3d p_O;
    int triangle = -1;  ///< of the object, the last nearest one
  };
  HandAndObject who_;
  SiteKind kind_;
  std::vector<ContactSite> sites_;
  std::vector<Place> places_;
  Pose X_OW_;
};

}  // namespace clench
