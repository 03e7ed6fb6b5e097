// Converts a world to a list of drawn items.
#pragma once
#include "clench/model/world.h"
#include "clench/scene/drawn.h"
#include "clench/scene/scene_options.h"

namespace clench {

/// Bodies in creation order with the colors of scene/palette.h, then a cone for each patch at which
/// a part of a robot touches an object, opening into the object by its friction angle. With
/// `patches`, each soft contact shows the fitted surface of the object, or of the touched body,
/// within the region of the fit, and on it the rim of the contact ellipse at 5 N.
/// throws  Error if a cone height is negative or not finite, or a force is not finite
Scene make_scene(const World& world, const SceneOptions& options = {});

}  // namespace clench
