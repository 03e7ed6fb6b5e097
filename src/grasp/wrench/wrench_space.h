// Grasp wrench space: the wrenches on the object that the contacts can resist, and with what
// effort.
#pragma once
#include <optional>
#include <vector>

#include "clench/base/progress.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/grasp/wrench/unit_wrenches.h"
#include "clench/grasp/wrench/wrench_support.h"
#include "clench/math/pose.h"

namespace clench {

struct WrenchSpaceOptions {
  WrenchNorm norm = WrenchNorm::l1;
  /// coordinates used, in this order: 2 to 6 different ones of fx fy fz tx ty tz, from 0
  std::vector<int> coordinates = {0, 1, 2, 3, 4, 5};

  bool operator==(const WrenchSpaceOptions&) const = default;
};

/// The external wrench on the object that a grasp resists worst. Contacts balance w by -w, so w is
/// resisted if -w lies in the space.
struct Weakest {
  Vector6d direction = Vector6d::Zero();  ///< unit; 0 in unused coordinates
  /// largest multiple resisted; 0: none; negative: all contacts push along it, by at least that
  /// much
  double resistance = 0;
  /// contacts that resist it with their full force, and so fail first; empty if it is not resisted
  std::vector<int> contacts;
};

struct EpsilonOptions {
  /// sufficient difference upper - lower, >= 0; no space is computed more accurately than 1e-12 of
  /// its size
  double tolerance = 1e-6;
  std::optional<double> at_least = {};  ///< stop once it is known whether epsilon reaches this
};

/// lower <= epsilon <= upper. lower is certified by a polytope inside the space, upper by the
/// support of the space in one direction.
struct EpsilonBounds {
  double lower = 0, upper = 0;
  /// upper - lower is within the tolerance; otherwise at_least was decided earlier, or the accuracy
  /// is the best attainable
  bool converged = true;
};

/// lower <= volume <= upper: of the space with round cones replaced by inscribed pyramids, and by
/// the same pyramids enlarged until they are circumscribed.
struct VolumeBounds {
  double lower = 0, upper = 0;
};

/// All wrenches that contacts resist with bounded normal forces. L1: they sum to one; the convex
/// hull of the unit wrenches of all contacts. L-infinity: each is at most one; the Minkowski sum of
/// the hulls of zero and each contact's unit wrenches.
///
/// Given by its support function: results are computed on demand and cached. For one thread at a
/// time. Long computations throw Stopped if their progress requests a stop.
/// source  Ferrari & Canny (1992)
class WrenchSpace {
 public:
  /// contacts  empty: nothing is resisted. Any number, size or rank of wrenches
  /// throws    Error if a number is not finite or the coordinates are invalid
  explicit WrenchSpace(std::vector<UnitWrenches> contacts, WrenchSpaceOptions options = {});
  explicit WrenchSpace(std::vector<Wrenches> contacts, WrenchSpaceOptions options = {});

  /// Radius of the largest ball about the origin inside the space; 0 without force closure. In [0,
  /// sqrt(1 + mu^2)] in L1. Within 1e-12 of the space's size; with round cones within 1e-9, or, if
  /// 500,000 facets are not sufficient for that (rings of equal contacts, huge friction), a
  /// certified lower bound.
  double epsilon(const Progress& progress = {}) const;
  /// A less accurate epsilon, which takes less time; if stopped, the bounds found so far.
  /// throws Error if tolerance < 0 or not finite
  EpsilonBounds epsilon_bounds(const EpsilonOptions& options, const Progress& progress = {}) const;
  /// Volume of the space in its coordinates; 0 if it is flat. With round cones the middle of its
  /// bounds.
  /// throws  Error if the hull has more than a million facets or, in L-infinity, the sum more than
  ///         60,000 cells, which is detected within about two seconds: five hard contacts of eight
  ///         edges or three soft ones have fewer
  double volume(const Progress& progress = {}) const;
  /// edges   of the pyramids for round cones, 4 to max_edges; a soft contact's are those of
  ///         friction_edges with half as many directions. Without round cones both bounds are the
  ///         volume
  /// throws  Error as volume, or if edges are out of range
  VolumeBounds volume_bounds(int edges = 32, const Progress& progress = {}) const;
  bool is_force_closure(const Progress& progress = {}) const;
  int rank() const;  ///< dimension of the span of the wrenches, 0 to that of the space
  const Weakest& weakest(const Progress& progress = {}) const;

  const std::vector<UnitWrenches>& contacts() const { return contacts_; }
  const WrenchSpaceOptions& options() const { return options_; }
  int dimension() const { return static_cast<int>(options_.coordinates.size()); }
  /// does any contact have a round cone?
  bool is_round() const;

  /// The complete hull, computed by qhull. Its points are the columns of all contacts in order; it
  /// has no facets unless it is full-dimensional.
  /// throws  Error in L-infinity or if a contact has a round cone
  Hull hull() const;

  /// The space, times 2^-scale_exponent, so that its size is about one.
  const WrenchSupport& scaled_reach() const { return prepared().reach; }
  int scale_exponent() const { return prepared().exponent; }

 private:
  // scaled to size about one
  struct Prepared {
    int exponent;
    double zero;  // a facet at most this far from the origin contains it
    WrenchSupport reach;
  };
  struct Bracket {
    double lower, upper, tolerance;
    Eigen::VectorXd direction;
    bool outside;
  };
  const Prepared& prepared() const;
  ContactWrenches wrenches() const { return {contacts_, options_.coordinates}; }
  WrenchSupport support_in_l1() const;  // scaled
  Bracket bracket_of(const WrenchSupport& reach, double tolerance, double at_least,
                     const Progress& progress) const;
  const Bracket& final_bracket(const Progress& progress) const;
  Weakest unresisted(const Progress& progress) const;
  double hull_volume(const Progress& progress) const;
  double sum_of_hulls_volume(const Progress& progress) const;
  Eigen::MatrixXd spanning() const;
  Vector6d in_all_coordinates(const Eigen::VectorXd& x) const;

  std::vector<UnitWrenches> contacts_;
  WrenchSpaceOptions options_;
  mutable std::optional<Prepared> prepared_;
  mutable std::optional<int> rank_;
  mutable std::optional<bool> closure_;
  mutable std::optional<Bracket> bracket_, final_;  // the nearest so far; that of epsilon
  mutable std::optional<double> volume_;
  mutable std::optional<std::pair<int, VolumeBounds>> volume_bounds_;  // for each number of edges
  mutable std::optional<Weakest> weakest_;
};

}  // namespace clench
