// Contact manifolds kept from step to step: a pair is measured again only after it has moved by as
// much as its gap.
#pragma once
#include "clench/dynamics/tree/articulation.h"

namespace clench {

/// Bodies rest at gaps of at least this fraction of the contact threshold.
inline constexpr double rest_gap = 0.25;
/// Points follow their bodies as long as these have moved by no more than this fraction of the
/// threshold.
inline constexpr double follows_within = 0.05;
/// Pairs farther apart than this are not examined until something has moved by half of it [m].
inline constexpr double manifold_reach = 0.02;

/// Upper bound on the displacement of any point of b relative to a from one pose to the other, on a
/// straight path [m].
double displacement(const Pose& X_AB, const Pose& other, const Shape& b);

/// Gap between the surfaces of a pair at its present poses: negative if a round piece penetrates
/// the other body, 0 for any other overlap [m].
/// limit  the largest gap that is returned [m]
double pair_gap(World& world, const Manifold& manifold, double limit);

/// Updates the list of pairs after bodies were added, removed, switched or moved far, and measures
/// those again that were placed from outside since the last step.
/// travel  upper bound on the displacement of any point of a body before the next call [m]
void find_manifolds(World& world, const System& system, double travel);

/// Measures a pair at its present poses. Points on the same features as before keep their forces;
/// those of a pair that begins to overlap are kept, so that it is pushed apart; a pair that was
/// placed overlapping gets those of the shortest displacement that separates it.
void measure(World& world, Manifold& manifold);

/// Measures all pairs that have moved farther than their points can follow; points of the others
/// follow their bodies. The torsion limits of soft points are up to date afterwards.
void update_manifolds(World& world);

/// Gaps of its points at the present poses of the pair, in the order of the points.
void update_gaps(const World& world, Manifold& manifold);

/// Updates the torsion radii of soft points under their last forces; each is computed again when
/// its force has changed by a twentieth. Patches are fitted only then.
/// points  of one manifold
void update_torsion(std::vector<ManifoldPoint>& points);

/// Gap of a point that follows its bodies, for the relative pose X_AB [m]; negative for an overlap.
double gap_of(const ManifoldPoint& point, const Pose& X_AB);

}  // namespace clench
