#include "clench/base/error.h"
#include "clench/render/render.h"

namespace clench {
namespace {

[[noreturn]] void refuse() { fail("this build has no pictures: configure with -DCLENCH_GL=ON"); }

}  // namespace

Picture render(const Scene&, const RenderOptions&, const Font&) { refuse(); }

void save_png(const Picture&, const std::string&) { refuse(); }

}  // namespace clench
