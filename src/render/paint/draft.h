// Draws a scene in one pass, with one shadow, in a fraction of the time of `paint`.
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

/// Data that drafts keep for the next one. Must not outlive its GlContext.
struct DraftKept {
  /// `most`: maximum memory of meshes [bytes]
  explicit DraftKept(size_t most) : meshes(most) {}
  size_t bytes() const;

  ExtentFinder extent;
  MeshStore meshes;
  DraftMarks marks;
  DraftShadow shadow;
  std::optional<DraftTarget> target;
};

/// Draws one sample per pixel and smooths edges; colors are premultiplied by alpha. `eye` is in the
/// world.
/// throws  Stopped; Error if the driver fails, and as `check(scene)` does
void draft_to(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
              const RenderOptions& options, const Destination& destination);

/// Draws options.draft_scale^2 samples per pixel, more than one.
/// throws  as `draft_to`
Picture draft_reduced(const Programs& programs, DraftKept& kept, const Scene& scene, const Eye& eye,
                      const RenderOptions& options);

/// Reads the picture from the bound framebuffer, from its lower left corner.
Picture read_frame(const RenderOptions& options);

}  // namespace clench
