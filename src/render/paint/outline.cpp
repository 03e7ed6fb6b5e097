#include "clench/render/paint/outline.h"

#include <epoxy/gl.h>

#include <cmath>

#include "clench/render/paint/tile.h"

namespace clench {

Outline::Outline(unsigned program, const Eye& eye, const RenderOptions& options)
    : program_(program), eye_(eye), options_(options) {}

void Outline::draw(const SeenTextures& seen, float cover, bool soft) const {
  const bool flat = eye_.ortho_height > 0;
  const double height = flat ? eye_.ortho_height : 2 * std::tan(eye_.field_of_view / 2);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl::bind(program_, "places", 1, seen.places);
  gl::bind(program_, "facings", 2, seen.facings);
  gl::bind(program_, "paints", 3, seen.paints);
  gl::set(program_, "eye", shading_eye(eye_));
  gl::set(program_, "spread", static_cast<float>(height / options_.height));
  gl::set(program_, "flat_view", flat ? 1.0f : 0.0f);
  gl::set(program_, "radius", static_cast<float>(options_.outline / 2));
  gl::set(program_, "cover", cover);
  gl::set(program_, "smooth_line", soft ? 1.0f : 0.0f);
  cover_.draw(program_);
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace clench
