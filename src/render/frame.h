// Where to look from: the view that holds a whole scene, and the matrix of a view.
#pragma once
#include "clench/render/draw_list.h"

namespace clench {

/// The nearest view from above and the side that holds every corner, with a margin; scene units. Of
/// twelve sides and two heights the first, unless another shows clearly more of contacts and of
/// what is seen through. `aspect` is width over height. An empty list: a view of a square of
/// size 1.
Eye frame(const DrawList& list, double aspect);

/// Columns right, up, back (out of the picture) of a view: a rotation.
/// An `up` along the view is replaced by the axis that is most across it.
/// throws  Error when a number is not finite, eye and target coincide or the field of view is out
///         of range
Eigen::Matrix3d view_axes(const Eye& eye);

/// To clip coordinates of OpenGL: x and y of what is seen in [-w, w], depth from near to far.
/// throws  Error as `view_axes` does
Eigen::Matrix4d view_projection(const Eye& eye, double aspect, double near, double far);

}  // namespace clench
