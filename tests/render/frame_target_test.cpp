#include <epoxy/gl.h>

#include <algorithm>

#include "clench/render/gl/gl_context.h"
#include "clench/render/paint/draft_target.h"
#include "clench/render/paint/tile.h"
#include "clench/render/renderer.h"
#include "letters.h"
#include "pictures.h"

using namespace clench;
using namespace clench::test;

namespace {

RenderOptions draft_of(Backdrop backdrop = Backdrop::studio, double outline = 0) {
  return {.width = 160,
          .height = 120,
          .quality = Quality::draft,
          .backdrop = backdrop,
          .outline = outline};
}

Scene glass_beside_box(double shift = 0) {
  Scene scene;
  scene.meshes.push_back(
      solid(box(1, 1, 1), {0.85f, 0.05f, 0.05f}, Pose::translation({shift, 0, 0})));
  scene.meshes.push_back(solid(ball(0.5), {0.2f, 0.5f, 0.9f}, Pose::translation({1.2, 0.3, 0})));
  scene.meshes.back().opacity = 0.4f;
  scene.ground = -0.5;
  return scene;
}

const Eye frame_eye{.eye = {3, -4, 2.5}, .target = {0.5, 0, 0}};

Picture drawn_afresh(const Scene& from, const RenderOptions& options) {
  Scene scene = from;
  scene.eye = frame_eye;
  return Renderer().draw(scene, options, letters());
}

struct GlState {
  std::vector<GLint> numbers;
  std::vector<GLfloat> reals;
  std::vector<GLboolean> switches;
  bool operator==(const GlState&) const = default;
};

GlState current_state() {
  GlState state;
  for (const GLenum what : {GL_VIEWPORT,
                            GL_BLEND_SRC_RGB,
                            GL_BLEND_DST_RGB,
                            GL_BLEND_SRC_ALPHA,
                            GL_BLEND_DST_ALPHA,
                            GL_DEPTH_FUNC,
                            GL_CULL_FACE_MODE,
                            GL_FRONT_FACE,
                            GL_ACTIVE_TEXTURE,
                            GL_CURRENT_PROGRAM,
                            GL_VERTEX_ARRAY_BINDING,
                            GL_ARRAY_BUFFER_BINDING,
                            GL_DRAW_FRAMEBUFFER_BINDING,
                            GL_READ_FRAMEBUFFER_BINDING,
                            GL_TEXTURE_BINDING_2D,
                            GL_TEXTURE_BINDING_2D_ARRAY,
                            GL_SAMPLER_BINDING,
                            GL_PACK_ALIGNMENT,
                            GL_UNPACK_ROW_LENGTH,
                            GL_PIXEL_PACK_BUFFER_BINDING,
                            GL_SCISSOR_BOX,
                            GL_COLOR_WRITEMASK,
                            GL_BLEND_EQUATION_RGB}) {
    GLint values[4] = {};
    glGetIntegerv(what, values);
    state.numbers.insert(state.numbers.end(), values, values + 4);
  }
  for (const GLenum what : {GL_COLOR_CLEAR_VALUE, GL_POLYGON_OFFSET_FACTOR, GL_POLYGON_OFFSET_UNITS,
                            GL_DEPTH_CLEAR_VALUE, GL_DEPTH_RANGE}) {
    GLfloat values[4] = {};
    glGetFloatv(what, values);
    state.reals.insert(state.reals.end(), values, values + 4);
  }
  for (const GLenum what : {GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_STENCIL_TEST,
                            GL_POLYGON_OFFSET_FILL, GL_FRAMEBUFFER_SRGB})
    state.switches.push_back(glIsEnabled(what));
  return state;
}

// typical OpenGL state of a user interface, and all other state that could affect a picture
void set_odd_state() {
  glEnable(GL_BLEND), glEnable(GL_SCISSOR_TEST), glEnable(GL_STENCIL_TEST), glEnable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glScissor(3, 4, 20, 10);
  glViewport(1, 2, 30, 40);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE, GL_ZERO, GL_DST_ALPHA);
  glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
  glStencilFunc(GL_NEVER, 0, 0);
  glDepthFunc(GL_NEVER), glDepthMask(GL_FALSE), glDepthRange(0.2, 0.7), glClearDepth(0.3);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glFrontFace(GL_CW), glCullFace(GL_FRONT_AND_BACK);
  glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
  glPolygonOffset(5, 6);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 7), glPixelStorei(GL_PACK_ALIGNMENT, 8);
  glActiveTexture(GL_TEXTURE3);
  unsigned name = 0;
  glGenTextures(1, &name), glBindTexture(GL_TEXTURE_2D, name);
  glGenSamplers(1, &name), glBindSampler(1, name), glBindSampler(3, name);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glGenBuffers(1, &name), glBindBuffer(GL_PIXEL_PACK_BUFFER, name);
  glGenVertexArrays(1, &name), glBindVertexArray(name);
}

}  // namespace

TEST_CASE("a frame that is read back equals the picture without labels, for each backdrop") {
  REQUIRE_PICTURES();
  Renderer renderer;
  Scene scene = glass_beside_box();
  scene.labels.push_back({.text = "not in frames"});
  Scene bare = scene;
  bare.labels.clear();
  for (const Backdrop backdrop : {Backdrop::studio, Backdrop::white, Backdrop::transparent})
    for (const double outline : {0.0, 2.0}) {
      const RenderOptions options = draft_of(backdrop, outline);
      renderer.draw_to({}, scene, frame_eye, options);
      CHECK(renderer.read() == drawn_afresh(bare, options));
    }
}

TEST_CASE("after changes of bodies, lamp, size and lines, frames equal those of a new renderer") {
  REQUIRE_PICTURES();
  Renderer renderer;
  RenderOptions wide = draft_of();
  wide.width = 200;
  const RenderOptions lined = draft_of(Backdrop::studio, 3);
  for (const double shift : {0.0, 0.1, 0.0, -0.4})
    for (const RenderOptions& options : {draft_of(), wide, lined, draft_of()}) {
      const Scene scene = glass_beside_box(shift);
      renderer.draw_to({}, scene, {.eye = {0, 4, 1}}, options);  // another position of the lamp
      renderer.draw_to({}, scene, frame_eye, options);
      CHECK(renderer.read() == drawn_afresh(scene, options));
    }
}

TEST_CASE("a mesh is stored once for any number of motions") {
  REQUIRE_PICTURES();
  Renderer renderer;
  Scene scene = glass_beside_box();
  renderer.draw_to({}, scene, frame_eye, draft_of());
  const size_t once = renderer.bytes();
  for (int i = 0; i < 5; ++i) {
    scene.meshes[0].X_WM.position.x() += 0.1;
    renderer.draw_to({}, scene, frame_eye, draft_of());
  }
  CHECK(renderer.bytes() == once);
}

TEST_CASE(
    "a frame in a framebuffer of the caller equals the picture, and the caller's state is "
    "restored") {
  REQUIRE_PICTURES();
  const GlContext context;
  const GlContext::Entered entered(context);
  const FrameTarget window(300, 220);
  const Scene scene = glass_beside_box();
  glBindFramebuffer(GL_FRAMEBUFFER, window.target);
  glClearColor(1, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  {
    Renderer renderer(Renderer::Context::caller);
    renderer.draw_to({window.target, 50, 30}, glass_beside_box(0.3), frame_eye, draft_of());
    set_odd_state();
    const GlState before = current_state();
    renderer.draw_to({window.target, 50, 30}, scene, frame_eye, draft_of());
    CHECK(current_state() == before);
    renderer.draw_to({}, scene, frame_eye, draft_of());
    CHECK(renderer.read() == drawn_afresh(scene, draft_of()));
    CHECK(current_state() == before);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, window.target);
  Picture all = empty_picture({.width = 300, .height = 220});
  read_tile({0, 0, 300, 220}, all);
  const Picture expected = drawn_afresh(scene, draft_of());
  int outside = 0, different = 0;
  for (int y = 0; y < 220; ++y)
    for (int x = 0; x < 300; ++x) {
      const int px = x - 50, py = y - (220 - 30 - 120);
      const bool within = px >= 0 && px < 160 && py >= 0 && py < 120;
      outside += !within && pixel(all, x, y) == Color{255, 0, 0};
      different += within && pixel(all, x, y) != pixel(expected, px, py);
    }
  CHECK(outside == 300 * 220 - 160 * 120);
  CHECK(different == 0);
}

TEST_CASE("pixels of covered parts are left out, and all others are those of the complete frame") {
  REQUIRE_PICTURES();
  const GlContext context;
  const GlContext::Entered entered(context);
  const RenderOptions options = draft_of();
  const FrameTarget window(options.width, options.height);
  Renderer renderer(Renderer::Context::caller);
  const auto drawn = [&](const std::vector<PixelRect>& covered) {
    glBindFramebuffer(GL_FRAMEBUFFER, window.target);
    glClearColor(1, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    renderer.draw_to({.framebuffer = window.target, .covered = covered}, glass_beside_box(),
                     frame_eye, options);
    glBindFramebuffer(GL_FRAMEBUFFER, window.target);
    Picture all = empty_picture(options);
    read_tile({0, 0, options.width, options.height}, all);
    return all;
  };
  const Picture complete = drawn({});
  // the edges of bodies cross those of the covered parts
  const std::vector<PixelRect> covered = {{0, 0, 80, 70}, {60, 50, 70, 70}, {150, 0, 10, 120}};
  const Picture part = drawn(covered);
  int outside = 0, equal = 0, left_out = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const PixelRect here{x, options.height - 1 - y, 1, 1};
      const bool is_covered =
          std::ranges::any_of(covered, [&](const PixelRect& r) { return r.contains(here); });
      const bool same = pixel(part, x, y) == pixel(complete, x, y);
      outside += !is_covered, equal += !is_covered && same, left_out += is_covered && !same;
    }
  CHECK(outside > 7500);
  CHECK(equal == outside);
  CHECK(left_out > 1000);
  CHECK(drawn({}) == complete);
}

TEST_CASE("frames that cannot be drawn or read are rejected") {
  REQUIRE_PICTURES();
  Renderer renderer;
  const Scene scene = glass_beside_box();
  CHECK_THROWS_WITH_AS(renderer.read(), "picture: there is no frame to read: call draw_to first",
                       Error);
  CHECK_THROWS_WITH_AS(renderer.draw_to({}, scene, frame_eye, {}),
                       "picture: frames must be drafts with one sample per pixel", Error);
  CHECK_THROWS_WITH_AS(renderer.draw_to({7}, scene, frame_eye, draft_of()),
                       "picture: a framebuffer needs a renderer that draws in the caller's context",
                       Error);
  CHECK_THROWS_WITH_AS(
      renderer.draw_to({{}, 1, 2}, scene, frame_eye, draft_of()),
      "picture: a frame of the renderer's own framebuffer begins at 0, 0, got 1, 2", Error);
}
