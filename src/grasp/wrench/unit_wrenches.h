// Wrenches that contacts exert with unit normal force, and their numbers scaled to size about one.
#pragma once
#include <optional>
#include <vector>

#include "clench/contact/cone.h"
#include "clench/grasp/wrench/wrench_support.h"

namespace clench {

/// Wrenches of a contact with unit normal force: the edges of a pyramid or any other wrenches, one
/// per column, or a round cone.
struct UnitWrenches {
  Wrenches edges;
  std::optional<RoundCone> round;  ///< instead of edges

  /// Number of the vectors that describe them: edges, or axis and spread of the round cone.
  Eigen::Index count() const { return round ? 1 + round->spread.cols() : edges.cols(); }
  /// Calls visit with each of these vectors.
  template <class Visit>
  void for_each(Visit visit) const {
    if (!round) {
      for (const auto& column : edges.colwise()) visit(column);
      return;
    }
    visit(round->axis);
    for (const auto& column : round->spread.colwise()) visit(column);
  }
};

/// options.edges may be round_edges.   throws  Error as cone_wrenches
UnitWrenches unit_wrenches(const PointContact& contact, const ConeOptions& options = {});

/// The pyramid inscribed in a round cone, or circumscribed about it.
/// edges  as of friction_edges; a soft contact's are those with half as many directions
Wrenches pyramid_of(const RoundCone& cone, int edges, bool around);

/// Unit wrenches of contacts in some of their coordinates. Functions with an exponent return
/// numbers times 2^-exponent, which is exact.
struct ContactWrenches {
  const std::vector<UnitWrenches>& contacts;
  const std::vector<int>& coordinates;

  int dimension() const { return static_cast<int>(coordinates.size()); }
  int exponent() const;                 ///< the least with which all scaled numbers are below one
  double max_norm(int exponent) const;  ///< scaled norm of the largest vector
  /// Vectors of all contacts in order, one per column: they have the same span as all wrenches.
  Eigen::MatrixXd columns(int exponent) const;
  WrenchSupport support(WrenchNorm norm, int exponent) const;
};

}  // namespace clench
