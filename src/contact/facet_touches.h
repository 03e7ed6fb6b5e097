// Contact points of triangle meshes: the points of all near triangle pairs, reduced to the outline
// of each patch.
#pragma once
#include <vector>

#include "clench/contact/touch.h"
#include "clench/geometry/query/queries.h"

namespace clench {

/// Distance below which two points of a patch are merged [m].
double merge_radius(const Shape& a, const Shape& b, const TouchOptions& options);

/// throws  Error if an option is negative or not finite, or max_per_patch < 1
void check(const TouchOptions& options);

/// contact_set() of the triangles; round pieces are ignored.
std::vector<Touch> facet_contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                                     const TouchOptions& options);

}  // namespace clench
