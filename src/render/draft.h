// A scene to pixels in one pass, with one shadow: a fraction of the time of `paint`.
#pragma once
#include "clench/render/mesh_store.h"
#include "clench/render/picture.h"
#include "clench/render/programs.h"
#include "clench/render/render_options.h"
#include "clench/render/shadows.h"

namespace clench {

/// Lives inside the life of a GlContext; `eye` is of the world. `store` holds meshes, `maps` one map of shadows.
/// throws  Stopped; Error when the driver refuses, and as `check(scene)` does
Picture draft(const Programs& programs, MeshStore& store, const Scene& scene, const Eye& eye,
              const RenderOptions& options);

}  // namespace clench
