// How the gap between two surfaces widens around a contact, and so over what they meet when one is
// pressed into the other.
#pragma once
#include <array>
#include <optional>

#include "contact/patch_sheet.h"

namespace clench {

/// Rays in the tangent plane from the middle of a patch.
struct PatchRays {
  static constexpr int count = 24;                ///< evenly about the middle
  static constexpr int places = 10;               ///< on each; the first is the middle
  std::array<Eigen::Vector2d, count> directions;  ///< unit
  std::array<double, count> lengths = {};         ///< to where the neighbourhood ends [m]
  std::array<double, count> known = {};           ///< to where the surfaces are known, no less [m]

  /// Where a place is, as a part of its ray: 0, 1/16, then by sqrt(2) farther each, up to 1.
  static double part(int place);
  /// of a ray, unit, in the plane whose x is the first one
  static const Eigen::Vector2d& direction(int ray);
};

/// A length on each ray [m].
using RayLengths = std::array<double, PatchRays::count>;

/// first   unit: of the first ray; the others turn on from x to y
/// sites   about the middle [m]
/// radius  of the neighbourhood of each [m]
PatchRays patch_rays(const Eigen::Vector2d& first, std::span<const Eigen::Vector2d> sites,
                     double radius);

/// Heights over the places of rays.
struct RayHeights {
  using Row = std::array<double, PatchRays::places>;
  std::array<Row, PatchRays::count> height;  ///< infinite where there is none [m]
  RayLengths end = {};                       ///< how far out along a ray there are some [m]
  RayLengths rim = {};  ///< the same beyond the neighbourhood, as far as the surface is known [m]
};

/// z of a surface.
RayHeights ray_heights(PatchSheet& sheet, const PatchRays& rays);

/// How far out along the rays there is a surface, as far as it is known [m].
RayLengths ray_rim(const PatchSheet& sheet, const PatchRays& rays);

/// The gap between two surfaces, from where it is least.
struct GapProfile {
  PatchRays rays;
  RayHeights gap;
};

/// a, b  over the same rays, each along the normal into its body
GapProfile gap_profile(const PatchRays& rays, const RayHeights& a, const RayHeights& b);

/// Of a ball-like surface over a plane: circles along the rays.
///
/// curvatures  along the first ray and across it; hollow counts as flat [1/m]
GapProfile gap_profile(const PatchRays& rays, const Eigen::Vector2d& curvatures);

/// The same as far as the surfaces of another go.
GapProfile cut(GapProfile profile, const GapProfile& other);

/// Where the surfaces meet when one is pressed into the other by `depth` [m]: mean of the products
/// of coordinates over the region around the middle where the gap is no wider; the first coordinate is
/// along the first ray [m^2]. Semi-axes of an ellipse with such moments are twice their roots.
Eigen::Matrix2d overlap(const GapProfile& profile, double depth);

/// Likewise of the polygon whose corners lie on the rays [m^2].
Eigen::Matrix2d star_moments(const RayLengths& corners);

/// How deep one is pressed into the other where the depths over the region where they meet sum to
/// `volume` [m^3]; nothing where they meet nowhere [m].
std::optional<double> depth_of(const GapProfile& profile, double volume);

}  // namespace clench
