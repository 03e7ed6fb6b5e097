// One scene as a picture, by OpenGL 3.3 through EGL without display: the same bytes for the same
// scene.
#pragma once
#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// Who draws several has them faster from a Renderer, and the same to the bit.
/// throws  Stopped; Error that says what to install when there is no EGL or no OpenGL 3.3, on a
///         size out of range, and on a number of the scene out of range, naming the mesh or cone
Picture render(const Scene& scene, const RenderOptions& options = {}, const Font& font = Font());

/// The view that `render` uses when the scene names none: everything that must be in the frame,
/// from above and that side which shows most of the contacts and of what is grasped. `aspect` is
/// width over height.
Eye frame_all(const Scene& scene, double aspect, bool ortho = false);

}  // namespace clench
