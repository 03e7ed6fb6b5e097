// Where bodies touch, kept from step to step: measured anew only when a pair has moved by as much
// as it was apart.
#pragma once
#include "clench/dynamics/tree/articulation.h"

namespace clench {

/// Bodies rest at gaps from this part of the contact threshold on.
inline constexpr double rest_gap = 0.25;
/// Points follow their bodies as long as these have moved by no more than this part of the
/// threshold.
inline constexpr double follows_within = 0.05;
/// Pairs farther apart than this are not looked at until something has moved by half of it [m].
inline constexpr double manifold_reach = 0.02;

/// No point of b has moved against a by more than this, from one pose to the other, on a straight
/// way [m].
double displacement(const Pose& X_AB, const Pose& other, const Shape& b);

/// The gap between the surfaces of a pair, where its bodies are: negative where a round piece lies
/// in the other body, 0 where they overlap otherwise [m].
/// limit  the largest gap that is returned [m]
double pair_gap(World& world, const Manifold& manifold, double limit);

/// Brings the list of pairs up to date with what was added, removed, switched or moved far, and
/// measures those anew that somebody has placed elsewhere since the last step.
/// travel  how far any point of a body may go before the next call [m]
void find_manifolds(World& world, const System& system, double travel);

/// Measures a pair where it is. Points that lie on the same features as before keep their forces;
/// those of a pair that has come to overlap stay, so that it is pushed apart; one that was placed
/// so gets those of the shortest way out.
void measure(World& world, Manifold& manifold);

/// Measures all pairs that have moved farther than their points can follow; of the others points
/// follow. The torsion that soft points resist is up to date afterwards.
void update_manifolds(World& world);

/// Gaps of its points where the pair is now, in the order of the points.
void update_gaps(const World& world, Manifold& manifold);

/// The radii by which soft points resist torsion under their last forces; each is found anew when
/// its force has changed by a twentieth. Patches are fitted only then.
/// points  of one manifold
void update_torsion(std::vector<ManifoldPoint>& points);

/// Of a point that follows its bodies, where these stand at X_AB [m]; negative where they overlap.
double gap_of(const ManifoldPoint& point, const Pose& X_AB);

}  // namespace clench
