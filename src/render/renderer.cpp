#include "clench/render/renderer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "clench/base/error.h"
#include "clench/render/figure/canvas.h"
#include "clench/render/gl/gl_context.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/paint/draft.h"
#include "clench/render/paint/painter.h"
#include "clench/render/paint/tile.h"
#include "clench/render/view/framed.h"
#include "clench/render/view/label_layout.h"

namespace clench {

namespace {

constexpr size_t max_kept = size_t{256} << 20;  // of meshes, and of a scene [bytes]

// what was stopped half way leaves nothing behind
void reset_state() {
  for (const GLenum what : {GL_BLEND, GL_DEPTH_TEST, GL_POLYGON_OFFSET_FILL, GL_CULL_FACE})
    glDisable(what);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  // also what is off: drivers compile anew for a state that they have not seen
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glPolygonOffset(1.5f, 2);
  glCullFace(GL_BACK);
  while (glGetError() != GL_NO_ERROR) {
  }
}

}  // namespace

// in this order, so that the context goes last
struct Renderer::Kept {
  GlContext context;
  struct Loaded {
    Programs programs;
    MeshStore meshes{max_kept};
    std::optional<SceneKey> key;
    std::optional<PaperScene> scene;
  };
  std::optional<Loaded> loaded;

  ~Kept() {
    if (!loaded) return;
    try {
      const GlContext::Entered entered(context);
      loaded.reset();
    } catch (const Error&) {
      // no context, no names to free in it: they go with it
      loaded->scene.reset(), loaded.reset();
    }
  }
};

struct Renderer::Framed {
  std::optional<FramedScene> last;
};

Renderer::Renderer() : framed_(std::make_unique<Framed>()) {}
Renderer::~Renderer() = default;

void Renderer::clear() {
  kept_.reset();
  framed_->last.reset();
}

size_t Renderer::bytes() const {
  if (!kept_ || !kept_->loaded) return 0;
  const auto& loaded = *kept_->loaded;
  return loaded.meshes.bytes() + (loaded.scene ? loaded.scene->bytes() : 0);
}

Picture Renderer::draw(const Scene& scene, const RenderOptions& options, const Font& font) {
  check(options);
  check(scene);
  const double aspect = static_cast<double>(options.width) / options.height;
  if (scene.eye) view_axes(*scene.eye);
  const Eye eye = scene.eye ? *scene.eye : frame_all(scene, aspect);

  if (!kept_) kept_ = std::make_unique<Kept>();
  Picture picture;
  {
    const GlContext::Entered entered(kept_->context);
    if (!kept_->loaded) kept_->loaded.emplace();
    auto& loaded = *kept_->loaded;
    reset_state();
    if (options.quality == Quality::draft) {
      picture = draft(loaded.programs, loaded.meshes, scene, eye, options);
      loaded.meshes.trim();
    } else {
      if (!loaded.scene || !loaded.key->matches(scene)) {
        loaded.scene.reset();
        loaded.key.emplace(scene);
        loaded.scene.emplace(loaded.programs, scene);
      }
      picture = paint(loaded.programs, *loaded.scene, loaded.scene->list().to_scene(eye), options);
      if (loaded.scene->bytes() > max_kept) loaded.scene.reset(), loaded.key.reset();
    }
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

Eye Renderer::frame_all(const Scene& scene, double aspect, bool ortho) {
  auto& last = framed_->last;
  if (!last || last->aspect != aspect || last->ortho != ortho || !last->key.matches(scene))
    last = FramedScene{SceneKey(scene), aspect, ortho, frame(scene, aspect, ortho)};
  return last->eye;
}

}  // namespace clench
