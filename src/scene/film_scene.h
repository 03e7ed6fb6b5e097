// One scene for all states of a film, from which its camera is chosen.
#pragma once
#include <span>

#include "clench/scene/scene.h"

namespace clench {

/// A scene for computing one view of several states of a world: the bodies of up to a dozen states
/// and, for all other states, the corners of bounding boxes that the view must hold. With
/// Framing::contacts it holds the objects that robots touch in some state, up to the last state in
/// which they do, and the parts of those robots from the palm outward; if nothing touches,
/// everything. A single state gives its scene.
/// throws  Error as make_scene does
Scene make_film_scene(std::span<const World* const> states, const SceneOptions& options = {});

}  // namespace clench
