// Automatic choice of views that hold a complete scene, and the matrices of a view.
#pragma once
#include <Eigen/Core>

#include "clench/scene/scene.h"

namespace clench {

/// The nearest view, from above and from the best side, that holds every vertex of the meshes that
/// must be in the frame, of cones and of arrows, with a margin; world. The first of twelve sides
/// and two heights, unless another shows clearly more of contacts and of transparent bodies, and
/// less of what need not be in the frame. `aspect` is width over height. An empty scene gives a
/// view of a square of size 1.
/// throws  Error if aspect is not > 0
Eye frame(const Scene& scene, double aspect, bool ortho = false);

/// Columns right, up, back (out of the picture) of a view: a rotation. An `up` along the view is
/// replaced by the axis that is most across it.
/// throws  Error if a number is not finite, eye and target coincide or the field of view is out of
///         range
Eigen::Matrix3d view_axes(const Eye& eye);

/// Projection to clip coordinates of OpenGL: x and y of visible points in [-w, w], depth from near
/// to far, which may lie behind an orthographic eye.
/// throws  Error as `view_axes` does
Eigen::Matrix4d view_projection(const Eye& eye, double aspect, double near, double far);

}  // namespace clench
