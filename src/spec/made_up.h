// What bodies of files have only because a body must have it.
#pragma once
#include <span>

#include "clench/base/listeners.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Notes masses and materials that no file gives, and warns of inertias that are a ball's because the surface bounds no
/// solid. Bodies without a surface are frames, and left out.
/// place  what the sentences begin with, "w.wld"
void tell_made_up(std::span<const BodySpec* const> bodies, const std::string& place,
                  const Listeners& listeners);

}  // namespace clench
