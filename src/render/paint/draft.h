// A scene to pixels in one pass, with one shadow: a fraction of the time of `paint`.
#pragma once
#include "clench/render/figure/picture.h"
#include "clench/render/gl/programs.h"
#include "clench/render/paint/mesh_store.h"
#include "clench/render/paint/shadows.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// Lives inside the life of a GlContext; `eye` is of the world, `store` holds meshes.
/// throws  Stopped; Error when the driver refuses, and as `check(scene)` does
Picture draft(const Programs& programs, MeshStore& store, const Scene& scene, const Eye& eye,
              const RenderOptions& options);

}  // namespace clench
