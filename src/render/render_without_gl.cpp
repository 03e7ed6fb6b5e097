#include "clench/base/error.h"
#include "clench/render/renderer.h"
#include "clench/render/view/frame.h"

namespace clench {
namespace {

[[noreturn]] void refuse() { fail("this build has no pictures: configure with -DCLENCH_GL=ON"); }

}  // namespace

// nothing to cache
struct Renderer::Kept {};
struct Renderer::Framed {};
Renderer::Renderer(Context context) : context_(context) {}
Renderer::~Renderer() = default;
void Renderer::clear() {}
size_t Renderer::bytes() const { return 0; }
Picture Renderer::draw(const Scene&, const RenderOptions&, const Font&) { refuse(); }
void Renderer::draw_to(const DrawTarget&, const Scene&, const Eye&, const RenderOptions&) {
  refuse();
}
Picture Renderer::read() { refuse(); }
void Renderer::finish() {}
Eye Renderer::frame_all(const Scene& scene, double aspect, bool ortho) {
  return frame(scene, aspect, ortho);
}

void save_png(const Picture&, const std::string&) { refuse(); }

}  // namespace clench
