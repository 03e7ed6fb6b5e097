// Masses, materials and inertias that no file gives.
#pragma once
#include <span>

#include "clench/base/diagnostic.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Notes masses and materials that no file gives, and warns of inertias that are a ball's because
/// the surface bounds no solid. Bodies without a surface are frames, and left out.
/// place      what the sentences begin with, "w.wld"
/// obstacles  stand beside the bodies; of their inertia nothing is told, for they never move
void tell_assumed(std::span<const BodySpec* const> bodies, const Place& place,
                  const Diagnostics& diagnostics, std::span<const BodySpec* const> obstacles = {});

}  // namespace clench
