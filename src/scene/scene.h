// A world as a list of drawn things.
#pragma once
#include "clench/model/world.h"
#include "clench/scene/drawn.h"
#include "clench/scene/scene_options.h"

namespace clench {

/// Bodies in creation order with the colors of scene/palette.h, then a cone for each patch where a
/// part of a robot touches an object, opening into the object by its friction angle. With `patches`,
/// at each soft contact the fitted surface of the object, or of the body that is touched, within the
/// region of the fit, and on it the rim of the contact ellipse at 5 N.
/// throws  Error on a cone height that is negative or not finite, and on a force that is not finite
Scene make_scene(const World& world, const SceneOptions& options = {});

}  // namespace clench
