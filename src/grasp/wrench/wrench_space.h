// Grasp wrench space: which wrenches on the object the contacts can resist, with how much effort.
#pragma once
#include <optional>
#include <vector>

#include "clench/base/progress.h"
#include "clench/contact/cone.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/grasp/wrench/wrench_support.h"
#include "clench/math/pose.h"

namespace clench {

/// What a contact does with unit normal force: the edges of a pyramid or any other wrenches, a
/// column each, or a round cone.
struct UnitWrenches {
  Wrenches edges;
  std::optional<RoundCone> round;  ///< instead of edges
};

/// options.edges may be round_edges.   throws  Error as cone_wrenches
UnitWrenches unit_wrenches(const PointContact& contact, const ConeOptions& options = {});

struct WrenchSpaceOptions {
  WrenchNorm norm = WrenchNorm::l1;
  /// those that count, in this order: 2 to 6 different ones of fx fy fz tx ty tz, from 0
  std::vector<int> coordinates = {0, 1, 2, 3, 4, 5};

  bool operator==(const WrenchSpaceOptions&) const = default;
};

/// The wrench on the object, from outside, that a grasp resists worst. Contacts answer w by -w, so
/// w is resisted when -w lies in the space.
struct Weakest {
  Vector6d direction = Vector6d::Zero();  ///< unit; 0 in coordinates that do not count
  /// largest multiple resisted; 0: none; below 0: all contacts push along it, by as much at least
  double resistance = 0;
  /// those that push against it with all they have, and so fail first; none when it is not resisted
  std::vector<int> contacts;
};

struct EpsilonOptions {
  /// upper - lower that is enough, >= 0; no space is told closer than 1e-12 of its size
  double tolerance = 1e-6;
  std::optional<double> at_least = {};  ///< enough to know whether epsilon reaches this
};

/// lower <= epsilon <= upper. lower is certified by a polytope inside the space, upper by a
/// direction in which the space reaches no farther.
struct EpsilonBounds {
  double lower = 0, upper = 0;
  /// upper - lower is within the tolerance; else at_least was known before, or it is as near as it
  bool converged = true;
  ///< came
};

/// lower <= volume <= upper: of the space with round cones replaced by pyramids within, and by the
/// same ones grown until they are around.
struct VolumeBounds {
  double lower = 0, upper = 0;
};

/// All wrenches that contacts resist with bounded normal forces. L1: they sum to one; the convex
/// hull of the unit wrenches of all contacts. L-infinity: each is at most one; the sum of the hulls
/// of zero and each contact's unit wrenches.
///
/// Known by its support function: nothing is calculated before it is asked for, and then kept. One
/// thread at a time. What takes long throws Stopped when its progress is told to stop.
/// source  Ferrari & Canny (1992)
class WrenchSpace {
 public:
  /// contacts  empty: nothing is resisted. Any number, size or rank of wrenches
  /// throws    Error when a number is not finite or the coordinates are not as they should be
  explicit WrenchSpace(std::vector<UnitWrenches> contacts, WrenchSpaceOptions options = {});
  explicit WrenchSpace(std::vector<Wrenches> contacts, WrenchSpaceOptions options = {});

  /// Radius of the largest ball about the origin inside the space; 0 unless force closure. In [0,
  /// sqrt(1 + mu^2)] in L1. Within 1e-12 of the space's size; with round cones within 1e-9, or,
  /// where 500,000 facets do not show that much (rings of alike contacts, huge friction), a
  /// certified lower bound.
  double epsilon(const Progress& progress = {}) const;
  /// An epsilon that is less certain, and found sooner; told to stop, the bounds found so far.
  /// throws Error when tolerance < 0 or not finite
  EpsilonBounds epsilon_bounds(const EpsilonOptions& options, const Progress& progress = {}) const;
  /// Of the space in its coordinates; 0 when it is flat. With round cones the middle of its bounds.
  /// throws  Error when the hull has more than a million facets or, in L-infinity, the sum more
  ///         than 60,000 cells, which is known within some two seconds: five hard contacts of eight
  ///         edges or three soft ones have fewer
  double volume(const Progress& progress = {}) const;
  /// edges   of the pyramids for round cones, 4 to max_edges; a soft contact's are those of
  ///         friction_edges with half as many directions. Without round cones both bounds are the
  ///         volume
  /// throws  Error as volume, or when edges are out of range
  VolumeBounds volume_bounds(int edges = 32, const Progress& progress = {}) const;
  bool is_force_closure(const Progress& progress = {}) const;
  int rank() const;  ///< dimension that the wrenches span, 0 to that of the space
  const Weakest& weakest(const Progress& progress = {}) const;

  const std::vector<UnitWrenches>& contacts() const { return contacts_; }
  const WrenchSpaceOptions& options() const { return options_; }
  int dimension() const { return static_cast<int>(options_.coordinates.size()); }
  /// has a contact a round cone?
  bool is_round() const;

  /// The whole hull by qhull. Its points are the columns of all contacts in order; no facets unless
  /// it is full.   throws  Error in L-infinity or when a contact has a round cone
  Hull hull() const;

  /// The space, times 2^-scale_exponent, so that it is of size about one.
  const WrenchSupport& scaled_reach() const { return prepared().reach; }
  int scale_exponent() const { return prepared().exponent; }

 private:
  // scaled to size about one
  struct Prepared {
    int exponent;
    double zero;  // what is no farther from the origin goes through it
    WrenchSupport reach;
  };
  struct Bracket {
    double lower, upper, tolerance;
    Eigen::VectorXd direction;
    bool outside;
  };
  const Prepared& prepared() const;
  WrenchSupport reach_in(WrenchNorm norm, int exponent) const;
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
  mutable std::optional<std::pair<int, VolumeBounds>> volume_bounds_;  // and their edges
  mutable std::optional<Weakest> weakest_;
};

}  // namespace clench
