// A scene to pixels in one pass, with one shadow: a fraction of the time of `paint`.
#pragma once
#include <optional>

#include "clench/render/figure/picture.h"
#include "clench/render/gl/programs.h"
#include "clench/render/mesh/extent.h"
#include "clench/render/paint/draft_shadow.h"
#include "clench/render/paint/draft_target.h"
#include "clench/render/paint/edge_pass.h"
#include "clench/render/paint/mesh_store.h"
#include "clench/render/view/render_options.h"

namespace clench {

/// What drafts leave for the next one. Lives inside the life of a GlContext.
struct DraftKept {
  /// `most`: bytes of meshes
  explicit DraftKept(size_t most) : meshes(most) {}
  size_t bytes() const;

  ExtentFinder extent;
  MeshStore meshes;
  DraftMarks marks;
  DraftShadow shadow;
  std::optional<DraftTarget> target;
};

/// Draws one sample a pixel and smooths edges; colors are multiplied by alpha. `eye` is of the
/// world.
/// throws  Stopped; Error when the driver refuses, and as `check(scene)` does
void draft_to(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
              const RenderOptions& options, const Destination& destination);

/// Draws options.draft_scale^2 samples a pixel, more than one.
/// throws  as `draft_to`
Picture draft_reduced(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
                      const RenderOptions& options);

/// The picture that the framebuffer that is bound holds, from its lower left corner.
Picture read_frame(const RenderOptions& options);

}  // namespace clench
