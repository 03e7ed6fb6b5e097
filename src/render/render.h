// Renders one scene as a picture, by OpenGL 3.3 through EGL without display. Equal scenes give
// equal bytes.
#pragma once
#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// For several pictures a Renderer is faster, with bit-identical results.
/// throws  Stopped; Error that says what to install if EGL or OpenGL 3.3 is missing, if a size is
///         out of range, and if a number of the scene is out of range, naming the mesh or cone
Picture render(const Scene& scene, const RenderOptions& options = {}, const Font& font = Font());

/// The view that `render` uses if the scene does not specify one: it holds everything that must be
/// in the frame, from above and from the side that shows most of the contacts and of the grasped
/// object. `aspect` is width over height.
Eye frame_all(const Scene& scene, double aspect, bool ortho = false);

}  // namespace clench
