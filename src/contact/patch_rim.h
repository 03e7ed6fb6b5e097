// How far the surfaces go on around a contact, and the ellipses that find room on them.
#pragma once
#include "contact/patch_gap.h"

namespace clench {

/// Along the rays of a patch.
struct PatchRim {
  RayLengths ends = {};    ///< where one of the surfaces ends, or as far as it was looked at [m]
  RayLengths looked = {};  ///< how far that is [m]

  bool ended(int ray) const { return ends[ray] < (1 - 1e-9) * looked[ray]; }
  bool any_ended() const;
};

/// a, b    where each of the two surfaces ends
/// looked  as far as both are known
PatchRim patch_rim(const RayLengths& a, const RayLengths& b, const RayLengths& looked);

/// The principal axis along which the region within the rim is longest, from the first ray [rad].
double rim_angle(const PatchRim& rim);

/// An ellipse as far as the surfaces have room for it.
struct RimEllipse {
  std::array<double, 2> semi_axes = {};  ///< along the first ray and across it [m]
  bool sure = true;  ///< false where it was made smaller and one looked no farther
};

/// The ellipse may lie anywhere on the surfaces, so in no direction is it wider than they are. Each
/// axis gives way by itself, and both together where it lies askew.
RimEllipse make_room(const PatchRim& rim, const std::array<double, 2>& semi_axes);

}  // namespace clench
