#include "clench/render/renderer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "clench/base/error.h"
#include "clench/render/figure/canvas.h"
#include "clench/render/gl/gl_context.h"
#include "clench/render/gl/gl_state.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/paint/draft.h"
#include "clench/render/paint/painter.h"
#include "clench/render/view/framed.h"
#include "clench/render/view/label_layout.h"

namespace clench {

namespace {

constexpr size_t max_kept = size_t{256} << 20;       // memory of meshes, and of a scene [bytes]
constexpr size_t max_kept_frame = size_t{64} << 20;  // memory kept after a picture [bytes]

// clears state left by a stopped picture
void reset_state() {
  for (const GLenum what : {GL_BLEND, GL_DEPTH_TEST, GL_POLYGON_OFFSET_FILL, GL_CULL_FACE})
    glDisable(what);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  // sets disabled state as well: drivers recompile for combinations that they have not seen
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glPolygonOffset(1.5f, 2);
  glCullFace(GL_BACK);
  while (glGetError() != GL_NO_ERROR) {
  }
}

double aspect_of(const RenderOptions& options) {
  return static_cast<double>(options.width) / options.height;
}

bool is_frame(const RenderOptions& options) {
  return options.quality == Quality::draft && options.draft_scale == 1;
}

}  // namespace

// objects of a context
struct RendererLoaded {
  Programs programs;
  DraftKept drafts{max_kept};
  std::optional<FrameTarget> frame;
  RenderOptions framed;  // options of the kept frame
  std::optional<SceneKey> key;
  std::optional<PaperScene> scene;
};

namespace {

void draw_frame(RendererLoaded& loaded, const Scene& scene, const Eye& eye,
                const RenderOptions& options) {
  auto& frame = loaded.frame;
  if (!frame || frame->width != options.width || frame->height != options.height) {
    frame.reset();
    frame.emplace(options.width, options.height);
  }
  loaded.framed = options;
  draft_to(loaded.programs, loaded.drafts, scene, eye, options, {frame->target});
}

Picture read_loaded(const RendererLoaded& loaded) {
  glBindFramebuffer(GL_FRAMEBUFFER, loaded.frame->target);
  return read_frame(loaded.framed);
}

Picture draw_draft(RendererLoaded& loaded, const Scene& scene, const Eye& eye,
                   const RenderOptions& options) {
  if (!is_frame(options)) return draft_reduced(loaded.programs, loaded.drafts, scene, eye, options);
  draw_frame(loaded, scene, eye, options);
  Picture picture = read_loaded(loaded);
  if (loaded.frame->bytes() > max_kept_frame) loaded.frame.reset();
  return picture;
}

Picture draw_paper(RendererLoaded& loaded, const Scene& scene, const Eye& eye,
                   const RenderOptions& options) {
  if (!loaded.scene || !loaded.key->matches(scene)) {
    loaded.scene.reset();
    loaded.key.emplace(scene);
    loaded.scene.emplace(loaded.programs, scene);
  }
  Picture picture =
      paint(loaded.programs, *loaded.scene, loaded.scene->list().to_scene(eye), options);
  if (loaded.scene->bytes() > max_kept) loaded.scene.reset(), loaded.key.reset();
  return picture;
}

}  // namespace

// declared in this order, so that the context is destroyed last
struct Renderer::Kept {
  std::optional<GlContext> context;  // empty: the caller's context is used
  std::optional<RendererLoaded> loaded;

  ~Kept();
};

// makes the renderer's context current, or saves the caller's state, during its lifetime
class Renderer::Entered {
 public:
  explicit Entered(Kept& kept) {
    if (kept.context)
      own_.emplace(*kept.context);
    else
      saved_.emplace();
    reset_state();
  }

 private:
  std::optional<GlContext::Entered> own_;
  std::optional<gl::SavedState> saved_;
};

Renderer::Kept::~Kept() {
  if (!loaded) return;
  try {
    const Entered entered(*this);
    loaded.reset();
  } catch (const Error&) {
    // without a context there are no objects to delete: they are deleted with it
    loaded->scene.reset(), loaded.reset();
  }
}

struct Renderer::Framed {
  std::optional<FramedScene> last;
};

Renderer::Renderer(Context context) : context_(context), framed_(std::make_unique<Framed>()) {}
Renderer::~Renderer() = default;

Renderer::Kept& Renderer::kept() {
  if (!kept_) {
    auto fresh = std::make_unique<Kept>();
    if (context_ == Context::own) fresh->context.emplace();
    kept_ = std::move(fresh);
  }
  return *kept_;
}

void Renderer::clear() {
  kept_.reset();
  framed_->last.reset();
}

size_t Renderer::bytes() const {
  if (!kept_ || !kept_->loaded) return 0;
  const auto& loaded = *kept_->loaded;
  return loaded.drafts.bytes() + (loaded.frame ? loaded.frame->bytes() : 0) +
         (loaded.scene ? loaded.scene->bytes() : 0);
}

Picture Renderer::draw(const Scene& scene, const RenderOptions& options, const Font& font) {
  check(options);
  check(scene);
  if (scene.eye) view_axes(*scene.eye);
  const Eye eye = scene.eye ? *scene.eye : frame_all(scene, aspect_of(options));
  Picture picture;
  {
    auto& loaded = kept().loaded;
    const Entered entered(*kept_);
    if (!loaded) loaded.emplace();
    picture = options.quality == Quality::draft ? draw_draft(*loaded, scene, eye, options)
                                                : draw_paper(*loaded, scene, eye, options);
    loaded->drafts.meshes.trim();
  }
  if (options.backdrop == Backdrop::white) picture = on_white(picture);
  Canvas canvas(picture, font);
  const Eigen::Vector2f size(options.width, options.height);
  for (const PlacedText& text :
       place_texts(scene, eye, size, font, static_cast<float>(options.letters)))
    canvas.bright_text({text.text, {text.box.low.x(), text.box.high.y()}, text.height}, text.color);
  picture.eye = eye;
  return picture;
}

void Renderer::draw_to(const DrawTarget& target, const Scene& scene, const Eye& eye,
                       const RenderOptions& options) {
  check(options);
  check(scene);
  view_axes(eye);
  if (!is_frame(options)) fail("picture: frames must be drafts with one sample per pixel");
  if (target.framebuffer && context_ == Context::own)
    fail("picture: a framebuffer needs a renderer that draws in the caller's context");
  if (!target.framebuffer && (target.x != 0 || target.y != 0))
    fail("picture: a frame of the renderer's own framebuffer begins at 0, 0, got {}, {}", target.x,
         target.y);
  auto& loaded = kept().loaded;
  const Entered entered(*kept_);
  if (!loaded) loaded.emplace();
  if (target.framebuffer)
    draft_to(loaded->programs, loaded->drafts, scene, eye, options,
             {*target.framebuffer, target.x, target.y, target.channels, target.covered});
  else
    draw_frame(*loaded, scene, eye, options);
  loaded->drafts.meshes.trim();
}

Picture Renderer::read() {
  if (!kept_ || !kept_->loaded || !kept_->loaded->frame)
    fail("picture: there is no frame to read: call draw_to first");
  const Entered entered(*kept_);
  Picture picture = read_loaded(*kept_->loaded);
  return kept_->loaded->framed.backdrop == Backdrop::white ? on_white(picture) : picture;
}

void Renderer::finish() {
  if (!kept_ || !kept_->loaded) return;
  const Entered entered(*kept_);
  glFinish();
}

Eye Renderer::frame_all(const Scene& scene, double aspect, bool ortho) {
  auto& last = framed_->last;
  if (!last || last->aspect != aspect || last->ortho != ortho || !last->key.matches(scene))
    last = FramedScene{SceneKey(scene), aspect, ortho, frame(scene, aspect, ortho)};
  return last->eye;
}

}  // namespace clench
