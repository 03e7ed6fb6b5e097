// Masses, materials and inertias that no file gives.
#pragma once
#include <span>

#include "clench/base/diagnostic.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Notes masses and materials that no file gives, and warns of inertias that are those of a ball
/// because the surface bounds no solid. Bodies without a surface are frames, and are skipped.
/// place      beginning of the messages, "w.wld"
/// obstacles  fixed bodies of the same file; their inertia is not reported, because they never move
void tell_assumed(std::span<const BodySpec* const> bodies, const Place& place,
                  const Diagnostics& diagnostics, std::span<const BodySpec* const> obstacles = {});

}  // namespace clench
