// Grasp wrench space: which wrenches on the object the contacts can resist, with how much effort.
#pragma once
#include <optional>
#include <vector>

#include "contact/cone.h"
#include "geometry/hull.h"
#include "math/pose.h"

namespace clench {

using Wrenches =
    Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< a column a wrench (force; torque / rho)

/// The wrench on the object, from outside, that a grasp resists worst. Contacts answer w by -w, so w
/// is resisted when -w lies in the hull: the worst direction runs against the normal of the facet
/// nearest to the origin.
struct Weakest {
  Vector6d direction = Vector6d::Zero();  ///< unit
  /// largest multiple resisted; 0: none; below 0: all contacts push along it, by as much at least
  double resistance = 0;
};

/// L1 wrench space: all that contacts resist when their normal forces sum to at most one. It is the convex
/// hull of the unit wrenches of all contacts.   source  Ferrari & Canny (1992)
class WrenchSpace {
 public:
  /// contacts  unit wrenches, one matrix a contact; empty: nothing is resisted. Any number, size or rank of them
  /// throws    Error when a number is not finite
  explicit WrenchSpace(std::vector<Wrenches> contacts);

  /// Radius of the largest ball about the origin inside the hull; 0 unless force closure. In [0, 1] for forces.
  double epsilon() const { return epsilon_; }
  /// Of the hull in six dimensions; 0 below rank 6.
  double volume() const { return hull_.volume; }
  bool is_force_closure() const { return epsilon_ > 0; }
  int rank() const { return rank_; }  ///< dimension that the wrenches span, 0..6
  const Weakest& weakest() const { return weakest_; }
  const std::vector<Wrenches>& contacts() const { return contacts_; }
  /// Its points are the columns of all contacts in order; no facets unless the hull is full.
  const Hull& hull() const { return hull_; }

 private:
  std::vector<Wrenches> contacts_;
  Hull hull_;
  int rank_ = 0;
  double epsilon_ = 0;
  Weakest weakest_;
};

}  // namespace clench
